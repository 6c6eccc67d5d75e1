#include "apps/session/session_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "apps/session/internal/session_luxmeter.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/formats/text_file.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

// Returns a box's keys: its lengths where a corner is at the origin, else its corners.
std::string BoxText(const SessionDraft& draft) {
  const Eigen::Vector3d& size = draft.size_m;
  const std::string guess = draft.size_because.empty() ? "" : "   # GUESS: " + draft.size_because;
  const std::string more =
      "# Furniture of more than half a metre, doors and windows may follow as [[scene.box]] and "
      "[[scene.opening]]:\n# `luxfit explain scene.box`. `luxfit room session.toml -o plan.svg` draws the "
      "room.\n";
  if (draft.corner_m.isZero(0))
    return fmt::format("[scene]\nsize = [{:g}, {:g}, {:g}]{}\n{}", size.x(), size.y(), size.z(), guess, more);
  const Eigen::Vector2d low = draft.corner_m, high = low + size.head<2>();
  return fmt::format(
      "[scene]\noutline = [[{0:g}, {1:g}], [{2:g}, {1:g}], [{2:g}, {3:g}], [{0:g}, {3:g}]]{4}\nheight = "
      "{5:g}{4}\n{6}",
      low.x(), low.y(), high.x(), high.y(), guess, size.z(), more);
}

std::string SceneText(const SessionDraft& draft) {
  std::string text = draft.mesh.empty() ? BoxText(draft)
                                        : fmt::format(
                                              "[scene]\nmesh = {}\nunit = \"{}\"   # GUESS: {}: the room is "
                                              "then {:.2f} x {:.2f} x {:.2f} m\n",
                                              Quoted(draft.mesh), draft.unit, draft.unit_because,
                                              draft.size_m.x(), draft.size_m.y(), draft.size_m.z());
  text += fmt::format(
      "\n# Reflectances that you know; those not named are estimated from the photos. The {} has:\n"
      "[scene.albedo]\n",
      draft.mesh.empty() ? "room" : "mesh");
  for (const auto& [material, area_m2] : draft.material_area_m2)
    text += fmt::format("# \"{}\" = 0.5   # {:.1f} m2\n", material, area_m2);
  return text + "\n";
}

std::string TagsText(const SessionDraft& draft) {
  std::string text =
      fmt::format("[tags]\nfamily = \"{}\"   # GUESS: {}\n", draft.family, draft.family_because);
  if (!draft.tags.empty()) return text + fmt::format("map = {}\n\n", Quoted(draft.tags));
  return text +
         "# Where each tag hangs: [{\"id\": 0, \"size_m\": 0.158, \"center_m\": [x, y, z], \"normal\": [out "
         "of the "
         "wall],\n# \"up\": [along the arrow]}]. Without a map the poses are those of one tag.\n"
         "# map = \"tags.json\"\nsize_m = 0.158   # GUESS: side of the black squares as `luxfit board tags` "
         "prints "
         "them on A4; measure one\n\n";
}

bool HasEightBits(const SessionDraft& draft, int camera) {
  return std::any_of(draft.photos.begin(), draft.photos.end(), [&](const DraftPhoto& photo) {
    return photo.camera == camera && photo.bits_per_channel == 8;
  });
}

// Returns whether two photos or more of one view and state are of the camera: a bracket tells its tone curve.
bool HasBrackets(const SessionDraft& draft, int camera) {
  constexpr int kFewestExposures = 2;
  std::map<std::pair<std::string, std::string>, int> exposures;
  for (const DraftPhoto& photo : draft.photos) {
    if (photo.camera == camera && ++exposures[{photo.name.view, photo.name.state}] >= kFewestExposures)
      return true;
  }
  return false;
}

std::string ResponseText(const SessionDraft& draft, int camera) {
  if (!HasEightBits(draft, camera))
    return "response = \"linear\"   # GUESS: 16-bit, float or RAW photos, developed without a tone curve\n";
  if (HasBrackets(draft, camera))
    return "response = \"estimate\"   # GUESS: 8-bit photos have a tone curve; two exposures of a view or "
           "more "
           "tell it\n";
  return "response = \"srgb\"   # GUESS: 8-bit photos have a tone curve; without two exposures of a view, "
         "that of "
         "sRGB is assumed\n";
}

std::string CameraText(const SessionDraft& draft, int camera) {
  std::string text = fmt::format("[[camera]]\nid = \"cam{}\"\n", camera);
  const auto file = draft.intrinsics.find(camera);
  if (file != draft.intrinsics.end()) {
    text += fmt::format("intrinsics = {}   # GUESS: it lies beside the photos and has their size\n",
                        Quoted(file->second));
  } else if (!draft.tags.empty()) {
    text += "# intrinsics = \"cam0.yaml\"   # absent: calibrated from the room's own tags\n";
  } else {
    text +=
        "# Photos of a board (`luxfit board aprilgrid -o board.pdf` prints one and the line to write), or a "
        "file:\n"
        "# calibration_images = \"board/*.png\"\n# intrinsics = \"cam0.yaml\"\n";
  }
  return text + ResponseText(draft, camera) +
         "vignetting = \"estimate\"   # GUESS: from surfaces seen at several places of the pictures\n"
         "black_level = 0   # GUESS: counts of a black photo; RAW files state their own\n\n";
}

std::string StatesText(const SessionDraft& draft) {
  if (draft.states.size() < 2)
    return "# One state, all on: the luminaires are counted and found. Photos of each alone tell more.\n"
           "[luminaires]\ncount = \"estimate\"   # GUESS: or their number\n\n";
  std::string text = "# What was on in each state, with its dimming from 0 to 1.\n[states]\n";
  for (const GuessedState& state : draft.states) {
    std::string on;
    for (size_t k = 0; k < state.luminaires.size(); ++k)
      on += fmt::format("{}{} = {:#.2g}", on.empty() ? "" : ", ", Quoted(state.luminaires[k]),
                        state.dimming.empty() ? 1.0 : state.dimming[k]);
    text += fmt::format("{} = {{ {} }}   # GUESS: {}\n", Quoted(state.id), on, state.because);
  }
  return text + "\n";
}

// Returns the states of readings that no photo has: a session cannot take such a table.
std::vector<std::string> StatesOfReadingsAlone(const SessionDraft& draft) {
  std::set<std::string> states;
  for (const SessionReading& reading : draft.readings) states.insert(reading.state);
  for (const GuessedState& state : draft.states) states.erase(state.id);
  return {states.begin(), states.end()};
}

// Returns id@state of the reading to propose for the scale: a measured one, where all is on if there is any.
std::string ReadingForScale(const SessionDraft& draft) {
  const SessionReading* best = nullptr;
  for (const SessionReading& reading : draft.readings) {
    const bool is_better = !best || (reading.state == "all" && best->state != "all");
    if (reading.is_measured && is_better) best = &reading;
  }
  return best ? best->id + "@" + best->state : "L1@all";
}

std::string LuxmeterText(const SessionDraft& draft) {
  const std::string opening =
      "# Readings of a luxmeter: one fixes the absolute scale, the others check the result. ";
  const std::string roles = fmt::format("# scale = [{}]\n# class = \"B\"\n", Quoted(ReadingForScale(draft)));
  if (draft.readings.empty())
    return opening + "Fill luxmeter.csv and\n# uncomment.\n# [luxmeter]\n# readings = \"luxmeter.csv\"\n" +
           roles;
  const std::vector<std::string> alone = StatesOfReadingsAlone(draft);
  if (!alone.empty())
    return opening +
           fmt::format(
               "luxmeter.csv has states that no\n# photo has ({}): correct them there, or add them to "
               "[states]; "
               "then uncomment.\n# [luxmeter]\n# readings = \"luxmeter.csv\"\n",
               ListNames(alone)) +
           roles;
  return opening +
         fmt::format(
             "Name the one in scale, and the\n# meter's class.\n[luxmeter]\nreadings = \"luxmeter.csv\"   # "
             "GUESS: it lies beside the session, with {} readings\n",
             draft.readings.size()) +
         roles;
}

// Says what is left to do about readings.
std::string ReadingsToDo(const SessionDraft& draft) {
  if (draft.readings.empty())
    return "luxmeter.csv: one reading at least, for lumens and lux; more to check the result";
  const std::vector<std::string> alone = StatesOfReadingsAlone(draft);
  if (!alone.empty())
    return fmt::format("luxmeter.csv: states that no photo has ({}): correct them, and uncomment [luxmeter]",
                       ListNames(alone));
  return fmt::format(
      "[luxmeter]: name in scale the reading of luxmeter.csv ({} are there) that sets lumens and lux",
      draft.readings.size());
}

std::vector<std::string> DoubtfulPhotos(const SessionDraft& draft) {
  std::vector<std::string> files;
  for (const DraftPhoto& photo : draft.photos) {
    if (IsDoubtful(photo.name)) files.push_back(photo.name.file);
  }
  return files;
}

}  // namespace

std::string SessionText(const SessionDraft& draft) {
  std::string text =
      "# A draft by `luxfit init`. Lines that end in GUESS are to be checked; `luxfit explain KEY` tells "
      "what a key "
      "means,\n# `luxfit doctor " +
      std::string("session.toml` what is still missing.\n\nname = ") + Quoted(draft.name) + "\n\n" +
      SceneText(draft) + TagsText(draft);
  for (int camera = 0; camera < draft.cameras; ++camera) text += CameraText(draft, camera);
  const std::vector<std::string> doubtful = DoubtfulPhotos(draft);
  if (!doubtful.empty())
    text += fmt::format("# Doubtful, see their notes in photos.csv: {}.\n", fmt::join(doubtful, ", "));
  if (draft.tone_mapped.mapped > 0)
    text += fmt::format("# {} do not tell light: {}.\n# Remedy: {}.\n", draft.tone_mapped.Names(),
                        ToneMappingInWords(draft.tone_mapped.sign), kToneMappingRemedy);
  text += "[photos]\ntable = \"photos.csv\"   # GUESS: views and states, " + draft.names_because + "\n\n";
  text += StatesText(draft);
  return text +
         "# What is known of a luminaire; all but the id may be absent. Everything else is found.\n"
         "# [[luminaire]]\n# id = \"A\"\n# photometry = \"downlight.ies\"\n# position_m = [1.5, 2.0, 2.8]\n"
         "# position_sigma_m = 0.5\n\n" +
         LuxmeterText(draft);
}

std::string PhotoTable(const SessionDraft& draft) {
  const bool has_notes = std::any_of(draft.photos.begin(), draft.photos.end(),
                                     [](const DraftPhoto& photo) { return !photo.name.note.empty(); });
  std::string text =
      std::string("file,camera,view,state,exposure_s,aperture,iso") + (has_notes ? ",note" : "") + "\n";
  const auto field = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : "";
  };
  for (const DraftPhoto& photo : draft.photos) {
    std::vector<std::string> fields = {CsvField(photo.name.file),        fmt::format("cam{}", photo.camera),
                                       CsvField(photo.name.view),        CsvField(photo.name.state),
                                       field(photo.exposure.exposure_s), field(photo.exposure.f_number),
                                       field(photo.exposure.iso)};
    if (has_notes) fields.push_back(CsvField(photo.name.note));
    text += CsvLine(fields);
  }
  return text;
}

std::string ReadingsTemplate() { return "id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx\n"; }

void NameMixByReadings(SessionDraft& draft) {
  const std::vector<std::string> alone = StatesOfReadingsAlone(draft);
  const auto is_unnamed = [](const GuessedState& state) { return state.is_unnamed; };
  if (alone.size() != 1 || std::count_if(draft.states.begin(), draft.states.end(), is_unnamed) != 1) return;
  GuessedState& mix = *std::find_if(draft.states.begin(), draft.states.end(), is_unnamed);
  for (DraftPhoto& photo : draft.photos) {
    if (photo.name.state == mix.id) photo.name.state = alone.front();
  }
  mix.id = alone.front();
  mix.is_unnamed = false;
  mix.because += "; its name is the one that only luxmeter.csv has";
}

std::vector<SessionReading> FilledReadings(const std::string& path) {
  const std::string text = ReadTextFile(path, "a table of readings");
  const bool is_template = text.substr(0, text.find_last_not_of(" \n") + 1) + "\n" == ReadingsTemplate();
  return is_template ? std::vector<SessionReading>{} : ReadReadingsAlone(path);
}

std::vector<std::string> ToDo(const SessionDraft& draft) {
  std::vector<std::string> list;
  if (draft.tone_mapped.mapped > 0)
    list.push_back(fmt::format("photos: take {} of {} again, in RAW: their cameras mapped tones locally",
                               draft.tone_mapped.mapped, draft.tone_mapped.of));
  if (!draft.size_because.empty())
    list.push_back("[scene]: measure the room; its lengths are a guess from where the tags hang");
  const auto count = std::count_if(draft.photos.begin(), draft.photos.end(),
                                   [](const DraftPhoto& photo) { return !photo.exposure.exposure_s; });
  if (count > 0)
    list.push_back(fmt::format("photos.csv: exposure_s of {} photos: their metadata lacks it", count));
  const size_t doubtful = DoubtfulPhotos(draft).size();
  if (doubtful > 0)
    list.push_back(
        fmt::format("photos.csv: view and state of {} photos, whose notes begin with CHECK", doubtful));
  if (draft.tags.empty())
    list.push_back(
        "[tags]: survey where the tags hang, and give the map: without it the scene's frame is not known");
  if (draft.intrinsics.empty() && draft.tags.empty())
    list.push_back("[[camera]]: intrinsics, or photos of a board: nothing calibrates the camera yet");
  if (draft.states.size() < 2)
    list.push_back("photos of each luminaire alone would tell more than one state does (not required)");
  list.push_back(ReadingsToDo(draft));
  return list;
}

}  // namespace luxfit
