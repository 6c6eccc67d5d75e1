#include "apps/demo_command.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace luxfit {
namespace {

namespace fs = std::filesystem;

std::string OfficeFolder() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path installed = program.parent_path().parent_path() / "share/luxfit/office",
                 source = LUXFIT_OFFICE;
  for (const fs::path& folder : {installed, source}) {
    if (fs::exists(folder / "session.toml")) return folder.string();
  }
  throw std::runtime_error("demo: expected the office's photos in " + installed.string() + " or " +
                           source.string() +
                           ", found none; install luxfit again, or run it on fixtures/office of the source");
}

}  // namespace

int DemoCommand(CommandOptions options) {
  options.session = OfficeFolder() + "/session.toml";
  const int status = RunCommand(options);
  if (!options.json)
    std::printf("\nThe office is a rendered room whose truth is known: %s/truth.json\n",
                OfficeFolder().c_str());
  return status;
}

}  // namespace luxfit
