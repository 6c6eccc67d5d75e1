// The program itself, run as a user runs it.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_PROGRAM_H_
#define LUXFIT_TESTS_SUPPORT_APPS_PROGRAM_H_

#include <stdio.h>
#include <sys/wait.h>

#include <array>
#include <stdexcept>
#include <string>

#include "tests/paths.h"

namespace luxfit::support {

struct ProgramRun {
  int status = -1;
  std::string output;  // standard output and standard error
};

// Throws std::runtime_error where the system has no shell.
inline ProgramRun RunProgram(const std::string& arguments) {
  FILE* pipe = popen(("{ '" LUXFIT_PROGRAM "' " + arguments + "; } 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("RunProgram: expected a shell, got none");
  ProgramRun run;
  std::array<char, 4096> buffer;
  for (size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    run.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_PROGRAM_H_
