#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/cli.h"
#include "apps/cli/parse_error.h"
#include "apps/cli/shell_commands.h"
#include "apps/text/process.h"
#include "apps/text/terminal.h"
#include "apps/version.h"
#include "forward/room/threads.h"

namespace {

// These are the exit statuses of docs/session-format.md.
constexpr int kBadInput = 2, kMissing = 3, kDefect = 70;

// Keeps memory that was freed for what is needed next. Matrices of tens of megabytes come and go in a fit; the system
// would clear each of their pages every time, which took a sixth of the time of `luxfit fit` in a large room.
void KeepFreedMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
}

int Run(const luxfit::Invocation& invocation) {
  const luxfit::ThreadLimit limit(invocation.threads);
  try {
    return invocation.run();
  } catch (const luxfit::MissingProgram& e) {
    luxfit::PrintError(e.what());
    return kMissing;
  } catch (const std::bad_alloc&) {
    luxfit::PrintError(
        "expected more memory than there is left; end other programs, lift the limit (ulimit -v, the "
        "container's), or ask "
        "for less: a larger patch_size_m, fewer --threads, smaller photos");
    return kMissing;
  } catch (const std::runtime_error& e) {
    luxfit::PrintError(e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    luxfit::PrintError(std::string("a defect of the program, please report it with the session: ") +
                       e.what());
    return kDefect;
  }
}

}  // namespace

int main(int argc, char** argv) {
  KeepFreedMemory();
  // Tables and progress lines keep their order where both streams go to one file.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  CLI::App app{
      "luxfit: luminaires, reflectances and their uncertainty from photos of a room and luxmeter readings",
      "luxfit"};
  app.set_version_flag("--version", luxfit::kVersion);
  app.require_subcommand(1);
  luxfit::Invocation invocation;
  invocation.command_line = fmt::format("{}", fmt::join(argv, argv + argc, " "));
  luxfit::AddStartCommands(app, invocation);
  luxfit::AddSessionCommands(app, invocation);
  luxfit::AddForwardCommands(app, invocation);
  luxfit::AddResultCommands(app, invocation);
  luxfit::AddRoomCommands(app, invocation);
  AddPhotoCommands(app, invocation);
  luxfit::AddShellCommands(app, invocation);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    luxfit::PrintError(luxfit::ParseErrorText(app, e, std::vector<std::string>(argv + 1, argv + argc)));
    return kBadInput;
  }
  return Run(invocation);
}
