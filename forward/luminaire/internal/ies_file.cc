#include "forward/luminaire/internal/ies_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>

#include "forward/luminaire/internal/ies_dialect.h"
#include "forward/luminaire/internal/photometry_planes.h"
#include "forward/luminaire/internal/photometry_text.h"
#include "forward/room/text_encoding.h"

namespace luxfit {
namespace {

constexpr double kLeastFactor = 1e-6, kLargestFactor = 1e6;

const std::map<IesVersion, std::string>& FirstLines() {
  static const std::map<IesVersion, std::string> lines{{IesVersion::k1986, ""},
                                                       {IesVersion::k1991, "IESNA91"},
                                                       {IesVersion::k1995, "IESNA:LM-63-1995"},
                                                       {IesVersion::k2002, "IESNA:LM-63-2002"},
                                                       {IesVersion::k2019, "IES:LM-63-2019"}};
  return lines;
}

std::string Upper(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

// The first line of 1986 is free text.
IesVersion VersionOf(const std::string& first_line) {
  const std::string line = Upper(Trimmed(first_line));
  for (const auto& [version, text] : FirstLines()) {
    if (!text.empty() && line == text) return version;
  }
  // Makers write the year in more than one way.
  if (line.rfind("IES", 0) != 0 || line.find("63") == std::string::npos) return IesVersion::k1986;
  if (line.find("2019") != std::string::npos || line.find("-19") + 3 == line.size()) return IesVersion::k2019;
  if (line.find("1995") != std::string::npos) return IesVersion::k1995;
  if (line.find("1991") != std::string::npos) return IesVersion::k1991;
  if (line.find("1986") != std::string::npos) return IesVersion::k1986;
  return IesVersion::k2002;
}

PhotometryKeyword KeywordOf(const std::string& line) {
  const size_t end = line.find(']');
  if (line.empty() || line.front() != '[' || end == std::string::npos || end == 1) return {"", line};
  std::string text = line.substr(end + 1);
  text.erase(0, text.find_first_not_of(" \t"));
  return {line.substr(1, end - 1), text};
}

IesTilt ReadTiltData(PhotometryText& text, const std::string& source) {
  IesTilt tilt;
  tilt.source = source;
  tilt.lamp_geometry = text.Count("lamp-to-luminaire geometry", 1, 3);
  const auto pairs = static_cast<size_t>(text.Count("number of tilt angles", 1, kMostCounted));
  tilt.angle_deg = text.Rising("tilt angles", pairs, -180, 180);
  tilt.factor = text.Numbers("tilt factors", pairs, 0);
  return tilt;
}

// Everything up to and with the line TILT=...; returns what stands after the equals sign.
std::string ReadHeader(PhotometryText& text, IesFile& file) {
  for (bool is_first = true;; is_first = false) {
    if (text.AtEnd())
      throw text.Error("TILT",
                       "expected a line TILT=NONE, TILT=INCLUDE or TILT=FILE before the numbers, got "
                       "the end of the file; is this an IES LM-63 file?");
    const std::string line = text.Line("header");
    const std::string_view trimmed = Trimmed(line);
    if (Upper(trimmed.substr(0, 4)) == "TILT") {
      const std::string_view after = Trimmed(trimmed.substr(4));
      if (after.substr(0, 1) == "=") return std::string(Trimmed(after.substr(1)));
    }
    if (is_first) file.version = VersionOf(line);
    if (!is_first || file.version == IesVersion::k1986) file.keywords.push_back(KeywordOf(line));
  }
}

// Vertical angles: type C from the nadir up, A and B about the horizontal.
struct Limits {
  double least, most;
};
Limits VerticalLimits(IesType type) {
  if (type == IesType::kC) return {0, 180};
  return type == IesType::kA ? Limits{-90, 90} : Limits{-180, 180};
}
Limits HorizontalLimits(IesType type) {
  if (type == IesType::kC) return {-180, 360};
  return type == IesType::kA ? Limits{-180, 180} : Limits{-90, 90};
}

}  // namespace

const std::string& FirstLineOf(IesVersion version) { return FirstLines().at(version); }

PlaneSymmetry IesPlaneSymmetry(const std::vector<double>& horizontal_deg) {
  if (horizontal_deg.size() == 1) return PlaneSymmetry::kRotational;
  const double first = horizontal_deg.front(), last = horizontal_deg.back();
  if (first == 0 && last == 90) return PlaneSymmetry::kQuadrant;
  if (first == 0 && last == 180) return PlaneSymmetry::kC0C180;
  if ((first == 90 && last == 270) || (first == -90 && last == 90)) return PlaneSymmetry::kC90C270;
  // 360 may be left out where it repeats 0.
  return first == 0 && last > 180 ? PlaneSymmetry::kNone : PlaneSymmetry::kPartial;
}

namespace {

void ExpectHorizontal(const PhotometryText& text, const IesFile& file) {
  const std::vector<double>& angles = file.horizontal_deg;
  if (file.type != IesType::kC) {
    if (angles.size() > 1) return;
    throw text.Error("horizontal angles", "expected two or more for photometry of type A or B, got one");
  }
  if (IesPlaneSymmetry(angles) != PlaneSymmetry::kPartial) return;
  throw text.Error("horizontal angles", "expected them from 0 to 0, 90, 180 or 360, or from 90 to 270, got " +
                                            NumberText(angles.front()) + " to " + NumberText(angles.back()) +
                                            "; add the planes that are missing");
}

void ReadCandela(PhotometryText& text, IesFile& file) {
  const size_t vertical = file.vertical_deg.size(), horizontal = file.horizontal_deg.size();
  file.candela = text.Numbers("candela values", vertical * horizontal, 0);
  if (*std::max_element(file.candela.begin(), file.candela.end()) <= 0)
    throw text.Error("candela values", "expected light in some direction, got 0 everywhere");
  const size_t surplus = text.NumbersAhead();
  if (surplus > 0) {
    text.Number("candela values");  // the line of the first
    throw text.Error("candela values",
                     "expected the end after " + std::to_string(vertical) + " x " +
                         std::to_string(horizontal) + " numbers, got " + std::to_string(surplus) +
                         " more; correct the numbers of angles, or remove what is too much");
  }
  if (!text.AtEnd()) file.notes.push_back("what follows the last candela value was ignored");
}

// The line of the lamps.
struct AngleCounts {
  size_t vertical, horizontal;
};
AngleCounts ReadMeasures(PhotometryText& text, IesFile& file) {
  AngleCounts counts{};
  file.lamps = text.Count("number of lamps", 1, kMostCounted);
  file.lumens_per_lamp = text.Number("lumens per lamp");
  if (file.lumens_per_lamp != -1 && !(file.lumens_per_lamp > 0))
    throw text.Error("lumens per lamp", "expected > 0, or -1 for absolute photometry, got " +
                                            NumberText(file.lumens_per_lamp) + "; correct it");
  file.multiplier = text.NumberWithin("candela multiplier", kLeastFactor, kLargestFactor);
  counts.vertical = static_cast<size_t>(text.Count("number of vertical angles", 2, kMostCounted));
  counts.horizontal = static_cast<size_t>(text.Count("number of horizontal angles", 1, kMostCounted));
  file.type = static_cast<IesType>(text.Count("photometric type (1 C, 2 B, 3 A)", 1, 3));
  file.in_feet = text.Count("units (1 feet, 2 metres)", 1, 2) == 1;
  file.width = text.NumberWithin("width", -kLargestFactor, kLargestFactor);
  file.length = text.NumberWithin("length", -kLargestFactor, kLargestFactor);
  file.height = text.NumberWithin("height", -kLargestFactor, kLargestFactor);
  return counts;
}

void ReadBallastLine(PhotometryText& text, IesFile& file) {
  file.ballast_factor = text.NumberWithin("ballast factor", kLeastFactor, kLargestFactor);
  file.third_factor = file.version <= IesVersion::k1991
                          ? text.NumberWithin("ballast-lamp photometric factor", kLeastFactor, kLargestFactor)
                          : text.Number("number after the ballast factor");
  file.input_w = text.Number("input watts");
}

// All that follows the line TILT=...
void ReadNumbers(PhotometryText& text, IesFile& file) {
  if (file.tilt.source == "INCLUDE") file.tilt = ReadTiltData(text, file.tilt.source);
  const AngleCounts counts = ReadMeasures(text, file);
  if (IesNumbersAhead(text, counts.vertical, counts.horizontal) == IesNumbers::kWithoutBallastLine)
    AddLightNote(file, LightNote::Of::kFlux,
                 "the line of ballast factor and watts is missing: the factor was taken as 1");
  else
    ReadBallastLine(text, file);
  const Limits v = VerticalLimits(file.type), h = HorizontalLimits(file.type);
  file.vertical_deg = text.Rising("vertical angles", counts.vertical, v.least, v.most);
  file.horizontal_deg = text.Rising("horizontal angles", counts.horizontal, h.least, h.most);
  ExpectHorizontal(text, file);
  ReadCandela(text, file);
}

// Calls `read` once it is known what commas are; returns whether they separate numbers without a blank.
template <typename Read>
bool ReadWithCommas(PhotometryText& text, const std::function<bool(PhotometryText&)>& fits,
                    const Read& read) {
  const IesCommas commas = CommasInNumbers(text, fits);
  try {
    read();
  } catch (const std::runtime_error& error) {
    if (commas != IesCommas::kUnclear) throw;
    throw std::runtime_error(std::string(error.what()) +
                             "; commas separate numbers in .ies: if they are decimal ones, write points");
  }
  return commas == IesCommas::kSeparate;
}

void AppendNumbers(std::string& out, const std::vector<double>& values) {
  constexpr size_t kLineLength = 100;  // the standard allows 256 and, before 2002, 132
  size_t line = 0;
  for (const double value : values) {
    const std::string number = NumberText(value);
    if (line > 0 && line + number.size() > kLineLength) {
      out += "\r\n";
      line = 0;
    } else if (line > 0) {
      out += ' ';
    }
    out += number;
    line += number.size() + 1;
  }
  out += "\r\n";
}

}  // namespace

IesFile ParseIes(const std::string& bytes, const std::string& name) {
  const std::string utf8 = Utf8Text(bytes);
  PhotometryText text(utf8, name, PhotometryText::Comma::kSeparates);
  IesFile file;
  file.name = name;
  file.tilt.source = ReadHeader(text, file);
  const std::string source = Upper(file.tilt.source);
  if (source.empty())
    throw text.Error("TILT", "expected NONE, INCLUDE or the name of a file after TILT=, got nothing");
  if (source == "NONE" || source == "INCLUDE") file.tilt.source = source;
  const auto fits = [&file](PhotometryText& numbers) {
    IesFile scratch = file;
    if (scratch.tilt.source == "INCLUDE") ReadTiltData(numbers, scratch.tilt.source);
    const AngleCounts counts = ReadMeasures(numbers, scratch);
    return IesNumbersAhead(numbers, counts.vertical, counts.horizontal) != IesNumbers::kDoNotFit;
  };
  if (ReadWithCommas(text, fits, [&] { ReadNumbers(text, file); }))
    file.notes.push_back("commas were read as separators: as decimal commas they would not fit the counts");
  return file;
}

IesFile ReadIes(const std::string& path) {
  IesFile file = ParseIes(FileBytes(path), path);
  if (file.tilt.source == "NONE" || file.tilt.source == "INCLUDE") return file;
  // Beside the .ies, whatever folder the name gives: that was on another machine.
  std::string name = file.tilt.source;
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path tilt_path =
      std::filesystem::path(path).parent_path() / std::filesystem::path(name).filename();
  if (!std::filesystem::is_regular_file(tilt_path))
    throw std::runtime_error(path + ": TILT: expected the file " + tilt_path.string() +
                             ", found none; put it there, or write TILT=NONE");
  const std::string utf8 = Utf8Text(FileBytes(tilt_path.string()));
  PhotometryText text(utf8, tilt_path.string(), PhotometryText::Comma::kSeparates);
  const auto fits = [](PhotometryText& numbers) {
    ReadTiltData(numbers, "");
    return numbers.NumbersAhead() == 0;
  };
  ReadWithCommas(text, fits, [&] {
    file.tilt = ReadTiltData(text, file.tilt.source);
    if (text.NumbersAhead() > 0) {
      text.Number("tilt factors");  // the line of the first
      throw text.Error("tilt factors", "expected the end after them, got more numbers; correct their number");
    }
  });
  return file;
}

std::string IesText(const IesFile& file) {
  std::string out = FirstLineOf(file.version);
  if (!out.empty()) out += "\r\n";
  for (const PhotometryKeyword& k : file.keywords)
    out += (k.name.empty() ? k.text : "[" + k.name + "] " + k.text) + "\r\n";
  const bool has_tilt = !file.tilt.angle_deg.empty();
  out += "TILT=" + (has_tilt ? "INCLUDE" : file.tilt.source) + "\r\n";
  if (has_tilt) {
    out += std::to_string(file.tilt.lamp_geometry) + "\r\n" + std::to_string(file.tilt.angle_deg.size()) +
           "\r\n";
    AppendNumbers(out, file.tilt.angle_deg);
    AppendNumbers(out, file.tilt.factor);
  }
  AppendNumbers(
      out, {static_cast<double>(file.lamps), file.lumens_per_lamp, file.multiplier,
            static_cast<double>(file.vertical_deg.size()), static_cast<double>(file.horizontal_deg.size()),
            static_cast<double>(file.type), file.in_feet ? 1.0 : 2.0, file.width, file.length, file.height});
  AppendNumbers(out, {file.ballast_factor, file.third_factor, file.input_w});
  AppendNumbers(out, file.vertical_deg);
  AppendNumbers(out, file.horizontal_deg);
  const auto vertical = static_cast<std::ptrdiff_t>(file.vertical_deg.size());
  for (auto row = file.candela.begin(); row != file.candela.end(); row += vertical)
    AppendNumbers(out, {row, row + vertical});
  return out;
}

}  // namespace luxfit
