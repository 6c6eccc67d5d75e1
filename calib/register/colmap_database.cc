#include "calib/register/colmap_files.h"

#include <sqlite3.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "calib/lens/camera_file.h"
#include "calib/register/internal/descriptor_matches.h"

namespace luxfit {
namespace {

class Database {
 public:
  explicit Database(const std::string& path) : path_(path) {
    sqlite3* raw = nullptr;
    const int status = sqlite3_open_v2(path.c_str(), &raw, SQLITE_OPEN_READWRITE, nullptr);
    handle_.reset(raw);
    if (status != SQLITE_OK) throw Error("expected COLMAP's database");
  }
  std::runtime_error Error(const std::string& expected) const {
    return std::runtime_error(path_ + ": " + expected + ", got: " + sqlite3_errmsg(handle_.get()));
  }
  void Run(const std::string& command) const {
    if (sqlite3_exec(handle_.get(), command.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      throw Error("expected COLMAP's tables");
  }
  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

class Statement {
 public:
  Statement(const Database& database, const std::string& sql) : database_(database) {
    sqlite3_stmt* raw = nullptr;
    const int status = sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &raw, nullptr);
    handle_.reset(raw);
    if (status != SQLITE_OK) throw database.Error("expected COLMAP's tables");
  }
  Statement& Bind(int at, std::int64_t value) {
    sqlite3_bind_int64(handle_.get(), at, value);
    return *this;
  }
  template <typename T>
  Statement& BindBlob(int at, const std::vector<T>& values) {
    sqlite3_bind_blob64(handle_.get(), at, values.data(), values.size() * sizeof(T), SQLITE_TRANSIENT);
    return *this;
  }
  bool Step() {
    const int status = sqlite3_step(handle_.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE)
      throw database_.Error("expected a database to write to");
    return status == SQLITE_ROW;
  }
  std::int64_t Integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }
  std::string Text(int column) const {
    return reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  }
  template <typename T>
  std::vector<T> Blob(int column) const {
    const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column));
    std::vector<T> values(bytes / sizeof(T));
    if (!values.empty())
      std::memcpy(values.data(), sqlite3_column_blob(handle_.get(), column), values.size() * sizeof(T));
    return values;
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  const Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

std::map<std::int64_t, std::string> ImageNames(const Database& database) {
  std::map<std::int64_t, std::string> names;
  Statement images(database, "SELECT image_id, name FROM images");
  while (images.Step()) names[images.Integer(0)] = images.Text(1);
  return names;
}

// Returns a row of COLMAP's keypoints: x, y, then either scale and orientation or a 2 x 2 shape.
std::vector<float> KeypointRow(const Eigen::Vector2d& pixel, std::int64_t columns) {
  const Eigen::Vector2d colmap_px = ToColmapPixel(pixel);
  std::vector<float> row(static_cast<std::size_t>(columns), 0.F);
  row[0] = static_cast<float>(colmap_px.x());
  row[1] = static_cast<float>(colmap_px.y());
  if (columns > 2) row[2] = 1;
  if (columns == 6) row[5] = 1;
  return row;
}

std::vector<TagDetection> SeenOnce(const std::vector<TagDetection>& tags) {
  std::map<int, int> times;
  for (const TagDetection& tag : tags) ++times[tag.id];
  std::vector<TagDetection> once;
  for (const TagDetection& tag : tags) {
    if (times[tag.id] == 1) once.push_back(tag);
  }
  return once;
}

// Appends the corners to the image's keypoints; returns the index of the first corner of each tag among them.
std::map<int, std::uint32_t> AppendCorners(const Database& database, std::int64_t image,
                                           const std::vector<TagDetection>& tags) {
  std::int64_t rows = 0, columns = 6;
  std::vector<float> keypoints;
  std::vector<std::uint8_t> descriptors;
  {
    Statement read(database, "SELECT rows, cols, data FROM keypoints WHERE image_id = ?");
    if (read.Bind(1, image).Step()) {
      rows = read.Integer(0);
      if (rows > 0) columns = read.Integer(1);
      keypoints = read.Blob<float>(2);
    }
    Statement read_descriptors(database, "SELECT data FROM descriptors WHERE image_id = ?");
    if (read_descriptors.Bind(1, image).Step()) descriptors = read_descriptors.Blob<std::uint8_t>(0);
  }
  std::map<int, std::uint32_t> first;
  for (const TagDetection& tag : SeenOnce(tags)) {
    first[tag.id] = static_cast<std::uint32_t>(rows);
    for (const Eigen::Vector2d& corner_px : tag.corners_px) {
      const std::vector<float> row = KeypointRow(corner_px, columns);
      keypoints.insert(keypoints.end(), row.begin(), row.end());
      ++rows;
    }
  }
  descriptors.resize(static_cast<std::size_t>(rows * kDescriptorSize), 0);
  Statement(database, "INSERT OR REPLACE INTO keypoints(image_id, rows, cols, data) VALUES(?, ?, ?, ?)")
      .Bind(1, image)
      .Bind(2, rows)
      .Bind(3, columns)
      .BindBlob(4, keypoints)
      .Step();
  Statement(database, "INSERT OR REPLACE INTO descriptors(image_id, rows, cols, data) VALUES(?, ?, ?, ?)")
      .Bind(1, image)
      .Bind(2, rows)
      .Bind(3, kDescriptorSize)
      .BindBlob(4, descriptors)
      .Step();
  return first;
}

using Matches = std::vector<std::uint32_t>;  // index in the first image, in the second, and so on
using ImagePair = std::pair<std::int64_t, std::int64_t>;

std::map<std::int64_t, DescriptorColumns> ReadDescriptors(const Database& database) {
  std::map<std::int64_t, DescriptorColumns> descriptors;
  Statement read(database, "SELECT image_id, data FROM descriptors");
  while (read.Step()) {
    const std::vector<std::uint8_t> bytes = read.Blob<std::uint8_t>(1);
    descriptors[read.Integer(0)] =
        Eigen::Map<const Eigen::Matrix<std::uint8_t, kDescriptorSize, Eigen::Dynamic>>(
            bytes.data(), kDescriptorSize, static_cast<Eigen::Index>(bytes.size()) / kDescriptorSize)
            .cast<float>();
  }
  return descriptors;
}

// Fewer are chance, and are no evidence beside the corners of tags (COLMAP 3.8, SiftMatching.min_num_inliers).
constexpr std::size_t kLeastMatches = 15;

std::map<ImagePair, Matches> MatchFeatures(const Database& database) {
  const std::map<std::int64_t, DescriptorColumns> descriptors = ReadDescriptors(database);
  std::vector<std::pair<ImagePair, Matches>> pairs;
  for (auto a = descriptors.begin(); a != descriptors.end(); ++a) {
    for (auto b = std::next(a); b != descriptors.end(); ++b) pairs.push_back({{a->first, b->first}, {}});
  }
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    const auto& [a, b] = pairs[i].first;
    pairs[i].second = MatchDescriptors(descriptors.at(a), descriptors.at(b));
  });
  std::map<ImagePair, Matches> matches;
  for (auto& [pair, of_pair] : pairs) {
    if (of_pair.size() / 2 >= kLeastMatches) matches[pair] = std::move(of_pair);
  }
  return matches;
}

}  // namespace

std::string MatchColmapImages(const std::string& path,
                              const std::map<std::string, std::vector<TagDetection>>& tags_of_image) {
  const Database database(path);
  std::map<ImagePair, Matches> matches = MatchFeatures(database);
  database.Run("BEGIN");
  const std::map<std::int64_t, std::string> names = ImageNames(database);
  std::map<std::int64_t, std::map<int, std::uint32_t>> corners;
  for (const auto& [image, name] : names) {
    const auto tags = tags_of_image.find(name);
    if (tags != tags_of_image.end()) corners[image] = AppendCorners(database, image, tags->second);
  }
  for (auto a = corners.begin(); a != corners.end(); ++a) {
    for (auto b = std::next(a); b != corners.end(); ++b) {
      for (const auto& [id, first_a] : a->second) {
        const auto first_b = b->second.find(id);
        if (first_b == b->second.end()) continue;
        Matches& of_pair = matches[{a->first, b->first}];
        for (std::uint32_t corner = 0; corner < 4; ++corner)
          of_pair.insert(of_pair.end(), {first_a + corner, first_b->second + corner});
      }
    }
  }
  database.Run("COMMIT");
  std::string text;
  for (const auto& [pair, of_pair] : matches) {
    text += names.at(pair.first) + " " + names.at(pair.second) + "\n";
    for (std::size_t i = 0; i + 1 < of_pair.size(); i += 2)
      text += std::to_string(of_pair[i]) + " " + std::to_string(of_pair[i + 1]) + "\n";
    text += "\n";
  }
  return text;
}

void NumberColmapImagesByName(const std::string& path) {
  const Database database(path);
  database.Run("BEGIN");
  database.Run(
      "CREATE TEMP TABLE numbers AS SELECT image_id AS old, ROW_NUMBER() OVER (ORDER BY name) AS number FROM "
      "images");
  // Numbers must be unique at every moment, so images first take numbers that no image has.
  for (const std::string table : {"images", "keypoints", "descriptors"}) {
    const std::string update = "UPDATE " + table + " SET image_id = ";
    database.Run(update + "1000000000 + (SELECT number FROM numbers WHERE old = image_id)");
    database.Run(update + "image_id - 1000000000");
  }
  database.Run("COMMIT");
}

std::map<std::string, ColmapImageIds> ReadColmapImageIds(const std::string& path) {
  const Database database(path);
  std::map<std::string, ColmapImageIds> ids;
  Statement images(database, "SELECT image_id, name, camera_id FROM images");
  while (images.Step()) ids[images.Text(1)] = {images.Integer(0), images.Integer(2)};
  return ids;
}

}  // namespace luxfit
