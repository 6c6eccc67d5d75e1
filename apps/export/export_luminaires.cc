#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/export/exports.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/input_error.h"

namespace luxfit {
namespace {

std::string BytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError({path, 0}, "",
                     "expected the file that the run wrote, found none; run `luxfit run` again");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

ExportedFiles ExportLuminaires(const FittedRoom& fitted, const std::string& folder) {
  ExportedFiles exported;
  for (const nlohmann::json& luminaire : fitted.result->at("luminaires")) {
    if (!luminaire.contains("files")) {
      exported.notes.push_back(
          "luminaire " + luminaire.at("id").get<std::string>() +
          " has no photometric files: the data do not determine its flux and distribution");
      exported.is_whole = false;
      continue;
    }
    for (const char* kind : {"ies", "ldt"}) {
      const std::filesystem::path source =
          fitted.out + "/" + luminaire.at("files").at(kind).get<std::string>();
      const std::string target = folder + "/" + source.filename().string();
      WriteText(target, BytesOf(source.string()));
      exported.files.push_back(target);
    }
  }
  return exported;
}

}  // namespace luxfit
