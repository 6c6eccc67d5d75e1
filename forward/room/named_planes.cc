#include "forward/room/named_planes.h"

#include <algorithm>
#include <map>
#include <string>

namespace luxfit {

bool AreNamedPlanes(const Scene& scene) {
  if (scene.surface.empty()) return false;
  std::map<std::string, int> count = {
      {"floor", 0}, {"ceiling", 0}, {"wall", 0}, {"surface", 0}, {"details", 0}};
  return std::all_of(scene.materials.begin(), scene.materials.end(), [&count](const std::string& name) {
    const std::string kind = name.substr(0, name.find(' '));
    if (kind == "found") return true;
    const auto at = count.find(kind);
    if (at == count.end()) return false;
    const int number = ++at->second;
    const bool is_single = number == 1 && (kind == "floor" || kind == "ceiling");
    return name == (is_single ? kind : kind + " " + std::to_string(number));
  });
}

}  // namespace luxfit
