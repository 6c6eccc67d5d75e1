#include "apps/text/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "apps/text/interrupt.h"
#include "apps/text/seconds.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

int OpenLog(const ProcessOptions& options, const std::vector<std::string>& words) {
  const int log = open(options.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log < 0) throw std::runtime_error(options.log + ": expected a writable file; " + std::strerror(errno));
  const std::string line = fmt::format("$ {}\n", fmt::join(words, " "));
  if (write(log, line.data(), line.size()) < 0) {
    close(log);
    throw std::runtime_error(options.log + ": expected room to write; " + std::strerror(errno));
  }
  return log;
}

// Between fork and exec only async-signal-safe calls are allowed, so everything is prepared before.
[[noreturn]] void BecomeProgram(char* const* arguments, char* const* environment, int log, pid_t parent) {
  setpgid(0, 0);
  // It ends with its caller, however that ends. A caller that ended before this line left it to another parent.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  const int none = open("/dev/null", O_RDONLY);
  dup2(none, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execvpe(arguments[0], arguments, environment);
  _exit(127);
}

std::vector<std::string> Environment(const std::map<std::string, std::string>& more) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (more.count(text.substr(0, text.find('='))) == 0) all.push_back(text);
  }
  for (const auto& [name, value] : more) all.push_back(fmt::format("{}={}", name, value));
  return all;
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

ProcessEnd WaitFor(pid_t child, double time_limit_s) {
  const double start_s = NowS();
  ProcessEnd end;
  int status = 0;
  while (true) {
    const pid_t waited = waitpid(child, &status, WNOHANG);
    if (waited == child) break;
    if (waited < 0 && errno != EINTR)
      throw std::runtime_error(std::string("cannot wait for a process; ") + std::strerror(errno));
    if (!end.timed_out && time_limit_s > 0 && NowS() - start_s > time_limit_s) end.timed_out = true;
    if (!end.interrupted && InterruptListener::WasInterrupted()) end.interrupted = true;
    if (end.timed_out || end.interrupted) kill(-child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (WIFEXITED(status)) end.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

}  // namespace

bool IsInstalled(const std::string& program) {
  const char* const path = std::getenv("PATH");
  if (path == nullptr) return false;
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::string ProcessEnd::Describe() const {
  if (interrupted) return "was stopped (Ctrl-C or SIGTERM)";
  if (timed_out) return "took longer than allowed and was stopped";
  if (signal != 0) return fmt::format("was ended by signal {} ({})", signal, strsignal(signal));
  return fmt::format("ended with status {}", status);
}

ProcessEnd RunProcess(const std::vector<std::string>& words, const ProcessOptions& options) {
  if (words.empty()) throw std::invalid_argument("RunProcess: expected a program");
  if (!IsInstalled(words.front()))
    throw MissingProgram(fmt::format(
        "expected the program {0}, found none on the PATH; install the package {0}", words.front()));
  std::vector<std::string> arguments = words, environment = Environment(options.environment);
  const std::vector<char*> argument_pointers = Pointers(arguments),
                           environment_pointers = Pointers(environment);
  const int log = OpenLog(options, words);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) BecomeProgram(argument_pointers.data(), environment_pointers.data(), log, parent);
  close(log);
  if (child < 0) throw std::runtime_error(std::string("cannot start a process; ") + std::strerror(errno));
  return WaitFor(child, options.time_limit_s);
}

}  // namespace luxfit
