// Runs a program as a child process, with its output in a log and its time limited. The program ends with its caller, and
// with the caller's wish to stop (apps/text/interrupt.h).
//
// Throws std::runtime_error where the process cannot be started or the log cannot be written.
#ifndef LUXFIT_APPS_TEXT_PROCESS_H_
#define LUXFIT_APPS_TEXT_PROCESS_H_

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace luxfit {

// Reports that a program which a command needs is missing: exit status 3.
class MissingProgram : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Tells whether an executable of that name is on the PATH.
bool IsInstalled(const std::string& program);

struct ProcessOptions {
  std::string log;          // file that standard output and standard error are appended to
  double time_limit_s = 0;  // 0: none; past it the process and its children are killed
  std::map<std::string, std::string> environment;  // added to the present environment
};

struct ProcessEnd {
  int status = -1;  // exit status; -1 where a signal ended it
  int signal = 0;
  bool timed_out = false;
  bool interrupted = false;  // Ctrl-C or SIGTERM came while an InterruptListener lived
  bool IsSuccess() const { return status == 0 && !timed_out && !interrupted; }
  std::string Describe()
      const;  // "ended with status 1", "was killed by signal 6", "took longer than allowed"
};

// Runs the program and waits for its end. The first word names the program, which is looked up on the PATH.
// Throws MissingProgram where it is not found.
ProcessEnd RunProcess(const std::vector<std::string>& words, const ProcessOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_PROCESS_H_
