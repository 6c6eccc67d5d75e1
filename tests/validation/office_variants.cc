// The office as worse cameras would have photographed it:
//   office_variants OFFICE_FOLDER VARIANT OUT_FOLDER
//
// vignetting: corners lose two fifths of their light (cos^4 and a mechanical loss); vignetting = "estimate".
//
// vignetted: the same, and nobody says so: vignetting = "none".
//
// bent: counts go with the power 0.9 of light, and nobody says so: response = "linear".
//
// tinted: luminaire C is warmer, its red 1.1 and its blue 0.592 of what they were (the same luminance on
// grey); states of one luminaire each.
//
// eight_bits: four exposures a photo, two stops apart, in 8 bits with the encoding of sRGB (PNG: without the
// losses of JPEG); response = "estimate".
//
// ambient: the light of luminaire D stands in for daylight. It is added to the photos and readings of A, B
// and C, and photographed and measured alone as the state off.
//
// dusk: the same daylight, which falls by 30 % from the first photo to the last, and from the first reading to the last. Each view's
// photos follow one another. dusk_by_state: all photos of a state do. clouds: it goes up and down by 30 % from photo to photo.
//
// textured: carpet on the floor, posters on the walls, wood on desks and cabinet, of the same mean reflectances
// (tests/validation/office_texture.h). The light that reaches each surface stays that of the plain room. Shot
// noise is multiplied as the light is. Prints the mean factor of each material.
//
// Then: luxfit run OUT_FOLDER/session.toml -o RESULT, and RESULT/result.json against the office's truth.json.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/calib/camera_model.h"
#include "tests/validation/office_texture.h"

namespace {

namespace fs = std::filesystem;

struct Row {
  std::string file, camera, view, state;
  double exposure_s;
};

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

std::vector<Row> ReadRows(const fs::path& office) {
  std::ifstream table(office / "photos.csv");
  std::vector<Row> rows;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    const std::vector<std::string> f = Fields(line);
    rows.push_back({f.at(0), f.at(1), f.at(2), f.at(3), std::stod(f.at(4))});
  }
  return rows;
}

// Full scale 1.
cv::Mat ReadLinear(const fs::path& path) {
  const cv::Mat counts = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (counts.type() != CV_16UC3) throw std::runtime_error(path.string() + ": expected 16-bit RGB");
  cv::Mat linear;
  counts.convertTo(linear, CV_32FC3, 1.0 / 65535);
  return linear;
}

void Write16(const fs::path& path, const cv::Mat& linear) {
  cv::Mat counts;
  linear.convertTo(counts, CV_16UC3, 65535);
  cv::imwrite(path.string(), counts);
}

// Text of the session with one replacement that must be possible.
std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("session.toml: expected to find " + from);
  return text.replace(at, from.size(), to);
}

std::string ReadText(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Holds where a pixel is: row and column, and the distance from the photo's middle (1: its corners).
struct PixelPlace {
  int v = 0, u = 0;
  double r = 0;
};

// Every photo changed pixel by pixel where it is not saturated: what saturated stays so. `change` takes the pixel,
// its place and the photo's row.
template <typename Change>
void WriteChanged(const fs::path& office, const fs::path& out, std::ofstream& table, const Change& change) {
  for (const Row& row : ReadRows(office)) {
    cv::Mat photo = ReadLinear(office / row.file);
    const double u0 = (photo.cols - 1) / 2.0, v0 = (photo.rows - 1) / 2.0;
    photo.forEach<cv::Vec3f>([&](cv::Vec3f& pixel, const int* at) {
      const double r = std::hypot(at[1] - u0, at[0] - v0) / (std::hypot(photo.cols, photo.rows) / 2);
      if (std::max({pixel[0], pixel[1], pixel[2]}) < 0.97f)
        pixel = change(pixel, PixelPlace{at[0], at[1], r}, row);
    });
    Write16(out / row.file, photo);
    table << row.file << ',' << row.camera << ',' << row.view << ',' << row.state << ',' << row.exposure_s
          << '\n';
  }
}

std::string Vignetted(const fs::path& office, const fs::path& out, std::ofstream& table) {
  WriteChanged(office, out, table, [](const cv::Vec3f& pixel, const PixelPlace& place, const Row&) {
    return pixel * luxfit::support::NaturalVignetting(place.r, 0.5);
  });
  return ReadText(office / "session.toml");
}

std::string Vignetting(const fs::path& office, const fs::path& out, std::ofstream& table) {
  return Replaced(Vignetted(office, out, table), "vignetting = \"none\"", "vignetting = \"estimate\"");
}

std::string Bent(const fs::path& office, const fs::path& out, std::ofstream& table) {
  WriteChanged(office, out, table, [](const cv::Vec3f& pixel, const PixelPlace&, const Row&) {
    return cv::Vec3f(std::pow(pixel[0], 0.9f), std::pow(pixel[1], 0.9f), std::pow(pixel[2], 0.9f));
  });
  return ReadText(office / "session.toml");
}

std::string Textured(const fs::path& office, const fs::path& out, std::ofstream& table) {
  const luxfit::OfficeTexture texture(office);
  texture.PrintMeans();
  std::map<std::string, cv::Mat> factors;  // by view
  for (const Row& row : ReadRows(office)) {
    if (factors.count(row.view) == 0) factors[row.view] = texture.FactorsIn(row.view);
  }
  WriteChanged(office, out, table, [&](const cv::Vec3f& pixel, const PixelPlace& place, const Row& row) {
    return pixel * factors.at(row.view).at<float>(place.v, place.u);
  });
  return ReadText(office / "session.toml");
}

std::string Tinted(const fs::path& office, const fs::path& out, std::ofstream& table) {
  for (const Row& row : ReadRows(office)) {
    if (row.state == "all" || row.state == "evening") continue;
    cv::Mat photo = ReadLinear(office / row.file);
    if (row.state == "C") {
      photo.forEach<cv::Vec3f>([](cv::Vec3f& pixel, const int*) {  // blue, green, red; saturated stays so
        if (std::max({pixel[0], pixel[1], pixel[2]}) < 0.97f)
          pixel = {0.592f * pixel[0], pixel[1], 1.1f * pixel[2]};
      });
    }
    Write16(out / row.file, photo);
    table << row.file << ',' << row.camera << ',' << row.view << ',' << row.state << ',' << row.exposure_s
          << '\n';
  }
  std::string session = ReadText(office / "session.toml");
  session = Replaced(session, "all = { A = 1.0, B = 1.0, C = 1.0, D = 1.0 }\n", "");
  session = Replaced(session, "evening = { A = 0.3, C = 1.0, D = 1.0 }\n", "");
  std::ifstream readings(office / "luxmeter.csv");
  std::ofstream written(out / "luxmeter.csv");
  for (std::string line; std::getline(readings, line);) {
    if (line.find(",all,") == std::string::npos && line.find(",evening,") == std::string::npos)
      written << line << '\n';
  }
  return Replaced(session, "L3@all", "L3@A");
}

std::string EightBits(const fs::path& office, const fs::path& out, std::ofstream& table) {
  for (const Row& row : ReadRows(office)) {
    const cv::Mat photo = ReadLinear(office / row.file);
    for (const double factor : {4.0, 1.0, 0.25, 0.0625}) {
      cv::Mat encoded(photo.size(), CV_8UC3);
      encoded.forEach<cv::Vec3b>([&](cv::Vec3b& pixel, const int* at) {
        const cv::Vec3f linear = photo.at<cv::Vec3f>(at[0], at[1]);
        for (int c = 0; c < 3; ++c) {
          // What saturated in the renderer's photo is brighter than anything here.
          const double x = linear[c] >= 0.97f ? 1.0 : std::min(1.0, linear[c] * factor);
          pixel[c] = static_cast<unsigned char>(std::lround(255 * luxfit::support::SrgbEncoded(x)));
        }
      });
      const std::string file =
          Replaced(row.file, ".png", "_" + std::to_string(std::lround(1000 * factor)) + ".png");
      cv::imwrite((out / file).string(), encoded);
      table << file << ',' << row.camera << ',' << row.view << ',' << row.state << ','
            << row.exposure_s * factor << '\n';
    }
  }
  return Replaced(ReadText(office / "session.toml"), "response = \"linear\"", "response = \"estimate\"");
}

// Says how much of its first daylight is left as a share of the photos, or of the readings, is done.
using Daylight = double (*)(double share_done);
double Steady(double /*share_done*/) { return 1; }
double Falling(double share_done) { return 1 - 0.3 * share_done; }
double Cloudy(double share_done) { return 1 + 0.3 * std::sin(100 * share_done); }

// Readings of A, B and C with those of D added, and D's as the state off. `daylight` falls from row to row.
void WriteAmbientReadings(const fs::path& office, const fs::path& out, Daylight daylight) {
  std::ifstream table(office / "luxmeter.csv");
  std::ofstream written(out / "luxmeter.csv");
  std::string line;
  std::getline(table, line);
  written << line << '\n';
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, double> ambient;
  while (std::getline(table, line)) {
    rows.push_back(Fields(line));
    if (rows.back().at(7) == "D") ambient[rows.back()[0]] = std::stod(rows.back().at(8));
  }
  for (size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::string> row = rows[r];
    if (row[7] == "all" || row[7] == "evening") continue;
    const double share = daylight(static_cast<double>(r) / static_cast<double>(rows.size()));
    if (row[7] == "D") {
      row[7] = "off";
      row[8] = std::to_string(share * ambient.at(row[0]));
    } else {
      row[8] = std::to_string(std::stod(row[8]) + share * ambient.at(row[0]));
    }
    for (size_t i = 0; i < row.size(); ++i) written << (i > 0 ? "," : "") << row[i];
    written << '\n';
  }
}

// The office with D as daylight, its photos taken in the order of `rows`.
std::string WithDaylight(const fs::path& office, const fs::path& out, std::ofstream& table,
                         const std::vector<Row>& rows, Daylight daylight) {
  std::map<std::string, Row> ambient;
  for (const Row& row : rows) {
    if (row.state == "D") ambient.emplace(row.view, row);
  }
  for (size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if (row.state == "all" || row.state == "evening" || ambient.count(row.view) == 0) continue;
    const auto share =
        static_cast<float>(daylight(static_cast<double>(r) / static_cast<double>(rows.size())));
    const Row& off = ambient.at(row.view);
    const cv::Mat seen = ReadLinear(office / off.file);
    // The sum saturates where either does; half the exposure leaves room for it.
    const bool is_off = row.state == "D";
    const cv::Mat light =
        is_off ? cv::Mat(seen.size(), seen.type(), cv::Scalar::all(0)) : ReadLinear(office / row.file);
    cv::Mat sum = (light + share * seen * (row.exposure_s / off.exposure_s)) / 2;
    sum.setTo(cv::Scalar::all(1), (light >= 0.97f) | (seen >= 0.97f));
    Write16(out / row.file, sum);
    table << row.file << ',' << row.camera << ',' << row.view << ',' << (is_off ? "off" : row.state) << ','
          << row.exposure_s / 2 << '\n';
  }
  WriteAmbientReadings(office, out, daylight);
  std::string session = ReadText(office / "session.toml");
  session = Replaced(session, "D = { D = 1.0 }", "off = {}");
  session = Replaced(session, "all = { A = 1.0, B = 1.0, C = 1.0, D = 1.0 }\n", "");
  session = Replaced(session, "evening = { A = 0.3, C = 1.0, D = 1.0 }\n", "");
  return Replaced(session, "L3@all", "L3@A");
}

std::string Ambient(const fs::path& office, const fs::path& out, std::ofstream& table) {
  return WithDaylight(office, out, table, ReadRows(office), Steady);
}

std::string Dusk(const fs::path& office, const fs::path& out, std::ofstream& table) {
  return WithDaylight(office, out, table, ReadRows(office), Falling);
}

std::string Clouds(const fs::path& office, const fs::path& out, std::ofstream& table) {
  return WithDaylight(office, out, table, ReadRows(office), Cloudy);
}

std::string DuskByState(const fs::path& office, const fs::path& out, std::ofstream& table) {
  std::vector<Row> rows = ReadRows(office);
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.state > b.state; });
  return WithDaylight(office, out, table, rows, Falling);
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, std::string (*)(const fs::path&, const fs::path&, std::ofstream&)> variants{
      {"vignetting", Vignetting}, {"vignetted", Vignetted}, {"bent", Bent}, {"tinted", Tinted},
      {"eight_bits", EightBits},  {"ambient", Ambient},     {"dusk", Dusk}, {"dusk_by_state", DuskByState},
      {"clouds", Clouds},         {"textured", Textured}};
  if (argc != 4 || variants.count(argv[2]) == 0) {
    std::fprintf(stderr,
                 "usage: office_variants OFFICE_FOLDER "
                 "vignetting|vignetted|bent|tinted|eight_bits|ambient|dusk|dusk_by_state|clouds|textured "
                 "OUT_FOLDER\n");
    return 2;
  }
  const fs::path office = argv[1], out = argv[3];
  try {
    fs::create_directories(out / "photos");
    for (const char* file : {"room.obj", "room.mtl", "cam0.yaml", "tags.json", "luxmeter.csv"})
      fs::copy_file(office / file, out / file, fs::copy_options::overwrite_existing);
    std::ofstream table(out / "photos.csv");
    table << "file,camera,view,state,exposure_s\n";
    std::ofstream(out / "session.toml") << variants.at(argv[2])(office, out, table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "office_variants: %s\n", error.what());
    return 2;
  }
  return 0;
}
