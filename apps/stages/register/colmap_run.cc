#include "apps/stages/register/colmap_run.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "apps/text/formats/artifact.h"
#include "apps/text/process.h"
#include "calib/lens/camera_file.h"
#include "calib/register/colmap_files.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

// Converts to eight bits for a feature detector: the brightest hundredth is white, and gamma keeps dark
// details.
std::string PortableGreymap(const ImagePlane& luminance) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(luminance.size()));
  for (Eigen::Index i = 0; i < luminance.size(); ++i) {
    if (std::isfinite(luminance.data()[i])) values.push_back(luminance.data()[i]);
  }
  float white = 1;
  if (!values.empty()) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
    std::nth_element(values.begin(), at, values.end());
    if (*at > 0) white = *at;
  }
  std::string bytes = fmt::format("P5\n{} {}\n255\n", luminance.cols(), luminance.rows());
  for (Eigen::Index v = 0; v < luminance.rows(); ++v) {
    for (Eigen::Index u = 0; u < luminance.cols(); ++u) {
      const float value = luminance(v, u);
      const float share = std::isfinite(value) ? std::clamp(value / white, 0.F, 1.F) : 1.F;
      bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(255 * std::pow(share, 1 / 2.2F))));
    }
  }
  return bytes;
}

// View names may hold any character; file names may not.
std::string ImageName(std::size_t picture) { return fmt::format("picture{:04}.pgm", picture); }

class ColmapJob {
 public:
  ColmapJob(const std::string& folder, const ColmapRunOptions& options, std::size_t pictures)
      : folder_(folder), options_(options), pictures_(static_cast<double>(pictures)) {}

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  // `limit_s` applies where the options give no limit.
  ProcessEnd Try(const std::string& command, const std::vector<std::string>& arguments,
                 double limit_s) const {
    std::vector<std::string> words{"colmap", command};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--random_seed", "0", "--log_to_stderr", "1"});
    ProcessOptions options;
    options.log = Path("colmap.log");
    options.time_limit_s = options_.time_limit_s > 0 ? options_.time_limit_s : limit_s;
    // Runs without a display; all files that it keeps, also temporary ones, stay in the folder.
    options.environment = {
        {"QT_QPA_PLATFORM", "offscreen"}, {"HOME", folder_.string()}, {"TMPDIR", folder_.string()}};
    return RunProcess(words, options);
  }

  void Run(const std::string& command, const std::vector<std::string>& arguments, double limit_s) const {
    Expect(command, Try(command, arguments, limit_s));
  }

  void Expect(const std::string& command, const ProcessEnd& end) const {
    if (!end.IsSuccess())
      throw ColmapFailed(fmt::format("{}: expected `colmap {}` to succeed, it {}; its last lines say why",
                                     Path("colmap.log"), command, end.Describe()));
  }

  double pictures() const { return pictures_; }

 private:
  fs::path folder_;
  ColmapRunOptions options_;
  double pictures_;
};

void Extract(const ColmapJob& job, const std::vector<ColmapPicture>& pictures,
             const std::vector<Camera>& cameras) {
  std::map<int, std::string> names;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    WriteText(job.Path("images/" + ImageName(i)), PortableGreymap(pictures[i].luminance));
    names[pictures[i].camera] += ImageName(i) + "\n";
  }
  for (const auto& [camera, list] : names) {
    const std::string list_path = job.Path(fmt::format("camera{}.txt", camera));
    WriteText(list_path, list);
    const ColmapCameraModel model = ToColmapModel(cameras[static_cast<std::size_t>(camera)]);
    job.Run("feature_extractor",
            {"--database_path", job.Path("database.db"), "--image_path", job.Path("images"),
             "--image_list_path", list_path, "--ImageReader.single_camera", "1", "--ImageReader.camera_model",
             model.name, "--ImageReader.camera_params", model.parameters, "--SiftExtraction.use_gpu", "0",
             "--SiftExtraction.num_threads", fmt::format("{}", tbb::this_task_arena::max_concurrency())},
            120 + 120 * job.pictures());
  }
  NumberColmapImagesByName(job.Path("database.db"));
}

void Match(const ColmapJob& job, const std::vector<ColmapPicture>& pictures) {
  std::map<std::string, std::vector<TagDetection>> tags;
  for (std::size_t i = 0; i < pictures.size(); ++i) tags[ImageName(i)] = pictures[i].tags;
  WriteText(job.Path("matches.txt"), MatchColmapImages(job.Path("database.db"), tags));
  job.Run("matches_importer",
          {"--database_path", job.Path("database.db"), "--match_list_path", job.Path("matches.txt"),
           "--match_type", "raw", "--SiftMatching.use_gpu", "0", "--SiftMatching.num_threads", "1"},
          120 + 10 * job.pictures() * job.pictures());
}

// Returns the options that triangulation and mapping share. A room has few views, so points of two views
// count.
std::vector<std::string> MapperArguments(const ColmapJob& job, const std::string& input,
                                         const std::string& output) {
  fs::create_directories(job.Path(output));
  std::vector<std::string> arguments{"--database_path",
                                     job.Path("database.db"),
                                     "--image_path",
                                     job.Path("images"),
                                     "--output_path",
                                     job.Path(output),
                                     "--Mapper.num_threads",
                                     "1",
                                     "--Mapper.tri_ignore_two_view_tracks",
                                     "0",
                                     "--Mapper.ba_refine_focal_length",
                                     "0",
                                     "--Mapper.ba_refine_principal_point",
                                     "0",
                                     "--Mapper.ba_refine_extra_params",
                                     "0"};
  if (!input.empty()) arguments.insert(arguments.end(), {"--input_path", job.Path(input)});
  return arguments;
}

// Writes a model of the pictures whose poses are known, without points, in COLMAP's own numbering.
void WriteKnownPoses(const ColmapJob& job, const std::vector<ColmapPicture>& pictures,
                     const std::vector<Camera>& cameras) {
  const std::map<std::string, ColmapImageIds> ids = ReadColmapImageIds(job.Path("database.db"));
  ColmapModel known;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto id = ids.find(ImageName(i));
    if (id == ids.end()) continue;
    known.cameras[id->second.camera] = cameras[static_cast<std::size_t>(pictures[i].camera)];
    if (pictures[i].cam_from_world)
      known.images[id->second.image] = {ImageName(i), id->second.camera, *pictures[i].cam_from_world, {}};
  }
  WriteText(job.Path("known/cameras.txt"), ColmapCamerasText(known.cameras));
  WriteText(job.Path("known/images.txt"), ColmapImagesText(known));
  WriteText(job.Path("known/points3D.txt"), ColmapPointsText(known));
}

// Returns the folder of the model, which need not exist.
std::string Map(const ColmapJob& job, const std::vector<ColmapPicture>& pictures,
                const std::vector<Camera>& cameras) {
  const auto known = std::count_if(pictures.begin(), pictures.end(), [](const ColmapPicture& picture) {
    return picture.cam_from_world.has_value();
  });
  const double limit_s = 300 + 120 * job.pictures();
  std::string input;
  if (known >= 2) {
    WriteKnownPoses(job, pictures, cameras);
    job.Run("point_triangulator", MapperArguments(job, "known", "triangulated"), limit_s);
    input = "triangulated";
  }
  std::vector<std::string> arguments = MapperArguments(job, input, "sparse");
  // In rooms of few features, a view of a few tags suffices, since their corners are accurate.
  arguments.insert(arguments.end(), {"--Mapper.multiple_models", "0", "--Mapper.extract_colors", "0",
                                     "--Mapper.min_model_size", "3", "--Mapper.init_min_num_inliers", "20",
                                     "--Mapper.abs_pose_min_num_inliers", "12",
                                     "--Mapper.fix_existing_images", input.empty() ? "0" : "1"});
  const ProcessEnd end = job.Try("mapper", arguments, limit_s);
  constexpr int kNoModel = 1;  // exit status where no pair of pictures starts a model
  if (end.status != kNoModel) job.Expect("mapper", end);
  return job.Path(input.empty() ? "sparse/0" : "sparse");
}

}  // namespace

ColmapRun RunColmap(const std::vector<ColmapPicture>& pictures, const std::vector<Camera>& cameras,
                    const std::string& folder, const ColmapRunOptions& options) {
  if (!IsInstalled("colmap"))
    throw MissingProgram("expected the program colmap, found none on the PATH; install the package colmap");
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  fs::create_directories(folder);
  const ColmapJob job(fs::absolute(folder).string(), options, pictures.size());
  Extract(job, pictures, cameras);
  Match(job, pictures);
  const std::string model = Map(job, pictures, cameras);
  ColmapRun run;
  if (fs::exists(fs::path(model) / "images.bin")) run.model_folder = model;
  for (std::size_t i = 0; i < pictures.size(); ++i) run.view_of_image[ImageName(i)] = pictures[i].view;
  return run;
}

}  // namespace luxfit
