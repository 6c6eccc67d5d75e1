#include "apps/stages/calibrate/image_grouping.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "apps/text/file_stem.h"

namespace luxfit {
namespace {

constexpr char kPhotosOf[] = "photos of ", kSetsOf[] = "sets of ";

Choice PhotosOfCamera(const CalibrationGroup& group, std::size_t camera) {
  std::size_t count = 0;
  std::set<std::string> folders;
  for (const CalibrationImage& image : group.input.images) {
    if (static_cast<std::size_t>(image.camera) != camera) continue;
    ++count;
    folders.insert(FileName(std::filesystem::path(image.name).parent_path().string()));
  }
  const std::string where = fmt::format("{}", fmt::join(folders, ", "));
  return {kPhotosOf + group.input.cameras[camera].id,
          std::to_string(count),
          {},
          where.empty() ? "as the table of corners names them" : "in " + where};
}

Choice SetsOfRig(const CalibrationGroup& group) {
  std::map<int, std::vector<std::string>> sets;
  for (const CalibrationImage& image : group.input.images) sets[image.set].push_back(FileName(image.name));
  std::string example;
  std::size_t shared = 0, alone = 0;
  for (const auto& [set, names] : sets) {
    (names.size() > 1 ? shared : alone) += 1;
    if (example.empty() && names.size() > 1) example = fmt::format("{}", fmt::join(names, " with "));
  }
  std::string ids;
  for (const CalibrationCamera& camera : group.input.cameras) ids += (ids.empty() ? "" : ", ") + camera.id;
  return {kSetsOf + ids,
          fmt::format("{}, by {}", shared, group.pairing),
          {"names", "numbers", "order", "none"},
          example + " and so on" + (alone > 0 ? fmt::format("; {} photos have no partner", alone) : "")};
}

}  // namespace

std::vector<Choice> GroupingChoices(const CalibrationGroup& group) {
  std::vector<Choice> choices;
  for (std::size_t c = 0; c < group.input.cameras.size(); ++c) choices.push_back(PhotosOfCamera(group, c));
  if (group.is_rig) choices.push_back(SetsOfRig(group));
  return choices;
}

bool IsGroupingChoice(const std::string& what) {
  return what.rfind(kPhotosOf, 0) == 0 || what.rfind(kSetsOf, 0) == 0;
}

}  // namespace luxfit
