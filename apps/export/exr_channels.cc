#include "apps/export/exr_channels.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <exception>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

namespace luxfit {
namespace {

void ExpectPlanes(const std::vector<ExrChannel>& channels) {
  if (channels.empty() || channels[0].values.size() == 0)
    throw std::invalid_argument("WriteExrChannels: expected at least one plane of pixels");
  std::set<std::string> names;
  for (const ExrChannel& channel : channels) {
    if (channel.name.empty() || !names.insert(channel.name).second)
      throw std::invalid_argument("WriteExrChannels: expected a name of its own for each channel");
    if (channel.values.rows() != channels[0].values.rows() ||
        channel.values.cols() != channels[0].values.cols())
      throw std::invalid_argument("WriteExrChannels: expected planes of one size");
  }
}

// Returns the slice of a plane for writing. OpenEXR takes a base address and strides in bytes; when it writes
// a file it does not write through the address.
Imf::Slice SliceOf(const float* values, Eigen::Index width) {
  char* const base = const_cast<char*>(reinterpret_cast<const char*>(values));
  return {Imf::FLOAT, base, sizeof(float), sizeof(float) * static_cast<size_t>(width)};
}

void Write(const std::string& path, const std::vector<ExrChannel>& channels,
           const std::map<std::string, std::string>& comments) {
  const ImagePlane& first = channels[0].values;
  Imf::Header header(static_cast<int>(first.cols()), static_cast<int>(first.rows()));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : comments) header.insert(key.c_str(), Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (const ExrChannel& channel : channels) {
    header.channels().insert(channel.name.c_str(), Imf::Channel(Imf::FLOAT));
    buffer.insert(channel.name.c_str(), SliceOf(channel.values.data(), first.cols()));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(static_cast<int>(first.rows()));
}

}  // namespace

void WriteExrChannels(const std::string& path, const std::vector<ExrChannel>& channels,
                      const std::map<std::string, std::string>& comments) {
  ExpectPlanes(channels);
  const std::string temporary = path + ".part";
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  try {
    Write(temporary, channels, comments);
    std::filesystem::rename(temporary, path);
  } catch (const std::exception&) {
    std::filesystem::remove(temporary, error);
    throw std::runtime_error(path + ": expected a writable place; check the folder and the free space");
  }
}

}  // namespace luxfit
