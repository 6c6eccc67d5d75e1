#include "apps/stages/stage_inputs.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "apps/stages/register/view_tags.h"
#include "apps/text/formats/artifact.h"
#include "forward/mesh/mesh_files.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

// Hashes path and content of a file; for a folder those of its files.
std::string HashPath(const std::string& path) {
  if (path.empty()) return "";
  std::error_code error;
  if (!fs::is_directory(path, error)) return HashText(path + HashFile(path));
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(path, error)) {
    if (entry.is_regular_file()) files.insert(entry.path().string());
  }
  std::string text = path;
  for (const std::string& file : files) text += file + HashFile(file);
  return HashText(text);
}

std::string HashMesh(const std::string& mesh) {
  std::string text;
  for (const std::string& file : FilesOfMesh(mesh)) text += HashPath(file);
  return text;
}

class Parts {
 public:
  explicit Parts(const Session& session) : session_(session), root_(toml::parse_file(session.path)) {}

  StageInputs Cameras() const {
    StageInputs inputs = {{"the program", HashFile("/proc/self/exe")},
                          {"[calibration]", Table("calibration")}};
    for (size_t c = 0; c < session_.cameras.size(); ++c) {
      const SessionCamera& camera = session_.cameras[c];
      std::string text = Element("camera", c);
      for (const std::string& file :
           {camera.intrinsics, camera.response_path, camera.vignetting_path, camera.calibration_corners})
        text += HashPath(file);
      for (const std::string& file : camera.calibration_images) text += HashPath(file);
      inputs["camera " + camera.id] = HashText(text);
    }
    return inputs;
  }

  static std::string NameOf(const SessionPhoto& photo) {
    return "photo " + fs::path(photo.file).filename().string();
  }

  StageInputs Photos(const std::set<std::string>& files) const {
    StageInputs inputs;
    for (const SessionPhoto& photo : session_.photos) {
      if (files.count(photo.file) == 0) continue;
      const std::string row =
          fmt::format("{} {} {} {} {} {}", photo.camera, photo.view, photo.state, photo.exposure_s,
                      photo.f_number.value_or(-1), photo.iso.value_or(-1));
      std::string& hash = inputs[NameOf(photo)];
      hash = HashText(fmt::format("{}{}{}", hash, row, HashPath(photo.file)));
    }
    return inputs;
  }

  std::set<std::string> AllPhotos() const {
    std::set<std::string> files;
    for (const SessionPhoto& photo : session_.photos) files.insert(photo.file);
    return files;
  }

  // Returns the photos that registration looks at.
  std::set<std::string> RegisteredPhotos() const {
    std::set<std::string> combinations, files;
    for (const SessionPhoto& photo : session_.photos)
      combinations.insert(fmt::format("{}\n{}\n{}", photo.view, photo.state, photo.camera));
    const bool has_brackets = combinations.size() < session_.photos.size();
    const bool is_linear = std::all_of(session_.cameras.begin(), session_.cameras.end(),
                                       [](const SessionCamera& c) { return c.response == "linear"; });
    if (has_brackets || !is_linear) return AllPhotos();
    for (const auto& [view, photos] : PhotosByView(session_, session_.photos)) {
      for (const SessionPhoto* photo : photos) files.insert(photo->file);
    }
    return files;
  }

  StageInputs Places() const {
    StageInputs inputs = {
        {"[tags]", HashText(Table("tags") + HashPath(session_.tags.map_path))},
        {"[registration]", HashText(Table("registration") + HashPath(session_.registration.colmap_model))}};
    if (!session_.scene) return inputs;
    if (session_.scene->outline) {
      std::string text = session_.scene->unit;
      for (const char* key : {"size", "outline", "height", "box", "opening", "furniture"})
        text += fmt::format("{} {}\n", key, Text(root_["scene"][key]));
      inputs["[scene]"] = HashText(text);
    } else {
      inputs["mesh " + fs::path(session_.scene->mesh).filename().string()] =
          HashText(session_.scene->unit + Text(root_["scene"]["furniture"]) + HashMesh(session_.scene->mesh));
    }
    return inputs;
  }

  StageInputs States() const {
    std::string ids;
    for (const SessionLuminaire& luminaire : session_.luminaires) ids += luminaire.id + "\n";
    return {{"[states]", HashText(Table("states") + Table("groups") + ids)}};
  }

  StageInputs Readings() const {
    const SessionLuxmeter& meter = session_.luxmeter;
    return {{"readings",
             HashText(Table("luxmeter") + HashPath(meter.readings_path) + HashPath(meter.sensitivity_path))}};
  }

  StageInputs Light(const std::string& earlier_luminaires) const {
    StageInputs inputs = {{"name", session_.name},
                          {"[luminaires]", Table("luminaires")},
                          {"[lights]", Table("lights")},
                          {"[scene.albedo]", HashText(Text(root_.at_path("scene.albedo")))},
                          {"scene.neutral", HashText(Text(root_.at_path("scene.neutral")))}};
    for (size_t k = 0; k < session_.luminaires.size(); ++k) {
      const SessionLuminaire& luminaire = session_.luminaires[k];
      if (luminaire.line == 0) continue;
      inputs["luminaire " + luminaire.id] =
          HashText(Element("luminaire", k) + HashPath(luminaire.photometry_path));
    }
    if (!earlier_luminaires.empty())
      inputs["--luminaires"] = HashPath(fs::absolute(earlier_luminaires).string());
    return inputs;
  }

 private:
  static std::string Text(toml::node_view<const toml::node> node) {
    std::ostringstream text;
    text << node;
    return text.str();
  }
  std::string Table(const std::string& name) const {
    return HashText(Text(toml::node_view<const toml::node>(root_[name])));
  }
  std::string Element(const std::string& list, size_t index) const {
    return Text(toml::node_view<const toml::node>(root_[list][index]));
  }

  const Session& session_;
  const toml::table root_;
};

StageInputs Union(StageInputs a, const StageInputs& b) {
  a.insert(b.begin(), b.end());
  return a;
}

}  // namespace

SessionInputs InputsOfStages(const Session& session, const std::string& earlier_luminaires) {
  const Parts parts(session);
  const StageInputs cameras = parts.Cameras(), photos = parts.Photos(parts.AllPhotos());
  SessionInputs inputs;
  inputs.linearize = Union(Union(cameras, photos), parts.States());
  inputs.registration =
      Union(Union(cameras, parts.Places()), Union(parts.Photos(parts.RegisteredPhotos()), parts.States()));
  inputs.observe = Union(Union(inputs.linearize, inputs.registration), parts.States());
  inputs.furniture = Union(inputs.observe, parts.Readings());
  inputs.result = Union(inputs.furniture, parts.Light(earlier_luminaires));
  return inputs;
}

Session ForRegistration(Session session) {
  session.luxmeter = {};
  if (session.scene) {
    session.scene->known_albedo_rgb.clear();
    session.scene->neutral.clear();
  }
  return session;
}

Session ForObservation(Session session) {
  for (SessionLuminaire& luminaire : session.luminaires) {
    SessionLuminaire bare;
    bare.id = luminaire.id;
    luminaire = bare;
  }
  return ForRegistration(std::move(session));
}

std::vector<std::string> ChangedInputs(const StageInputs& before, const StageInputs& now) {
  std::set<std::string> changed;
  for (const auto& [name, hash] : before) {
    const auto other = now.find(name);
    if (other == now.end() || other->second != hash) changed.insert(name);
  }
  for (const auto& [name, hash] : now) {
    if (before.count(name) == 0) changed.insert(name);
  }
  return {changed.begin(), changed.end()};
}

}  // namespace luxfit
