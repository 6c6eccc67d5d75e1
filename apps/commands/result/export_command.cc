#include "apps/commands/result/export_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/export/exports.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

using Export = std::function<ExportedFiles(const FittedRoom&, const std::string&, RunContext&)>;

// Wraps an export that does not need the context, which only maps of photos need.
Export Plain(ExportedFiles (*of)(const FittedRoom&, const std::string&)) {
  return
      [of](const FittedRoom& fitted, const std::string& folder, RunContext&) { return of(fitted, folder); };
}

std::vector<std::pair<std::string, Export>> Exports() {
  return {{"luminaires", Plain(ExportLuminaires)}, {"patches", Plain(ExportPatches)},
          {"radiance", Plain(ExportRadiance)},     {"luxmaps", ExportLuxMaps},
          {"luminance", ExportLuminance},          {"csv", Plain(ExportTables)},
          {"cameras", Plain(ExportCameras)}};
}

void ExpectKnown(const std::vector<std::string>& only) {
  const std::vector<std::string> names = ExportNames();
  for (const std::string& name : only) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::runtime_error("--only: " + ExpectedOneOf(names, name));
  }
}

std::string Relative(const std::string& path, const std::string& folder) {
  return std::filesystem::path(path).lexically_relative(folder).string();
}

}  // namespace

std::vector<std::string> ExportNames() {
  std::vector<std::string> names;
  for (const auto& [name, write] : Exports()) names.push_back(name);
  return names;
}

int ExportCommand(const ExportCommandOptions& options) {
  ExpectKnown(options.only);
  const FittedRoom fitted = ReadFittedRoom(options.out, options.session);
  const std::string folder =
      std::filesystem::absolute(options.folder.empty() ? fitted.out + "/export" : options.folder)
          .lexically_normal()
          .string();
  ExpectOwnFolders(fitted.out);
  RunContext context;
  context.out = folder;
  context.is_quiet = true;
  context.provenance = {options.command_line, fitted.session.input_files};
  json manifest = ProvenanceJson("luxfit-export-1", context.provenance);
  manifest["exports"] = json::object();
  bool is_whole = true;
  std::string text;
  for (const auto& [name, write] : Exports()) {
    const bool is_named = std::count(options.only.begin(), options.only.end(), name) > 0;
    if (!options.only.empty() && !is_named) continue;
    const ExportedFiles exported = write(fitted, (std::filesystem::path(folder) / name).string(), context);
    is_whole = is_whole && (exported.is_whole || !is_named);
    json files = json::array();
    for (const std::string& file : exported.files) files.push_back(Relative(file, folder));
    manifest["exports"][name] = {{"files", files}, {"notes", exported.notes}};
    text += fmt::format("{:<11} {} files\n", name, exported.files.size());
    for (const std::string& note : exported.notes) text += "            " + note + "\n";
  }
  WriteJson(folder + "/manifest.json", manifest);
  std::fputs(options.json ? JsonText(manifest).c_str() : text.c_str(), stdout);
  std::fprintf(stderr, "done      %s\n", (folder + "/manifest.json").c_str());
  return is_whole ? 0 : 1;
}

}  // namespace luxfit
