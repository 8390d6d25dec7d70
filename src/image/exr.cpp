#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfTestFile.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>

#include "image/srgb.h"

namespace whittle {
namespace {

static_assert(sizeof(Hit::id) == sizeof(unsigned int));

/// Where each fact lies in a Hit, and what the file calls it.
struct FactChannel {
  const char* name;
  Imf::PixelType type;
  size_t offset;
};

constexpr FactChannel kFactChannels[] = {
    {"Z", Imf::FLOAT, offsetof(Hit, distance)},
    {"N.X", Imf::FLOAT, offsetof(Hit, normal) + offsetof(Vec3f, x)},
    {"N.Y", Imf::FLOAT, offsetof(Hit, normal) + offsetof(Vec3f, y)},
    {"N.Z", Imf::FLOAT, offsetof(Hit, normal) + offsetof(Vec3f, z)},
    {"id", Imf::UINT, offsetof(Hit, id)},
};

/// The frame's hits as the place that facts are read from or written to.
Imf::FrameBuffer fact_buffer(const Hit* hits, const Imath::Box2i& window) {
  Imf::FrameBuffer buffer;
  const size_t width = size_t(int64_t(window.max.x) - window.min.x + 1);
  for (const FactChannel& c : kFactChannels) {
    const char* first = reinterpret_cast<const char*>(hits) + c.offset;
    buffer.insert(c.name,
                  Imf::Slice::Make(c.type, first, window, sizeof(Hit), sizeof(Hit) * width));
  }
  return buffer;
}

/// Linear, premultiplied colours of the picture, four halfs a pixel.
std::vector<half> linear_colors(const Picture& picture) {
  float decoded[256];
  for (int i = 0; i < 256; ++i) decoded[i] = linear_from_srgb(float(i) / 255);
  std::vector<half> colors(picture.rgba.size());
  for (size_t i = 0; i < colors.size(); i += 4) {
    const float alpha = float(picture.rgba[i + 3]) / 255;
    for (size_t k = 0; k < 3; ++k) colors[i + k] = decoded[picture.rgba[i + k]] * alpha;
    colors[i + 3] = alpha;
  }
  return colors;
}

Error bad_file(const std::string& path, const std::string& why) {
  return {ErrorKind::kInput, path + ": " + why};
}

const char* type_name(Imf::PixelType type) {
  return type == Imf::UINT ? "uint" : type == Imf::HALF ? "half" : "float";
}

Result<Frame> read_facts(const std::string& path) {
  Imf::InputFile file(path.c_str(), 1);
  const Imf::Header& header = file.header();
  for (const FactChannel& c : kFactChannels) {
    const Imf::Channel* channel = header.channels().findChannel(c.name);
    if (channel == nullptr) {
      return bad_file(path, std::string("no channel ") + c.name +
                                "; not a file of facts, as whittle writes them");
    }
    if (channel->type != c.type || channel->xSampling != 1 || channel->ySampling != 1) {
      return bad_file(path, std::string("channel ") + c.name + " must be " + type_name(c.type) +
                                " at every pixel");
    }
  }
  const Imath::Box2i window = header.dataWindow();
  const int64_t width = int64_t(window.max.x) - window.min.x + 1;
  const int64_t height = int64_t(window.max.y) - window.min.y + 1;
  // The header of a broken file may claim any size.
  constexpr int64_t kMaxSide = 1 << 16, kMaxPixels = int64_t(1) << 28;
  if (width <= 0 || height <= 0 || width > kMaxSide || height > kMaxSide ||
      width * height > kMaxPixels) {
    return bad_file(path, "the picture is empty or too large");
  }
  Frame frame{int(width), int(height)};
  file.setFrameBuffer(fact_buffer(frame.hits.data(), window));
  file.readPixels(window.min.y, window.max.y);
  return frame;
}

}  // namespace

Status write_exr(const std::string& path, const Frame& frame, const Picture& picture) {
  WHITTLE_CHECK(frame.width > 0 && frame.height > 0);
  WHITTLE_CHECK(frame.width == picture.width && frame.height == picture.height);
  errno = 0;
  try {
    Imf::Header header(frame.width, frame.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer = fact_buffer(frame.hits.data(), header.dataWindow());
    for (const FactChannel& c : kFactChannels) header.channels().insert(c.name, c.type);
    std::vector<half> colors = linear_colors(picture);
    const char* const names[] = {"R", "G", "B", "A"};
    for (size_t k = 0; k < 4; ++k) {
      header.channels().insert(names[k], Imf::HALF);
      buffer.insert(names[k], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(&colors[k]),
                                         4 * sizeof(half), 4 * sizeof(half) * size_t(frame.width)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(frame.height);
  } catch (const std::exception& e) {
    return Error{ErrorKind::kMachine,
                 path + ": cannot write: " + (errno != 0 ? std::strerror(errno) : e.what())};
  }
  return Done{};
}

Result<Frame> read_exr(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return bad_file(path, std::string("cannot read: ") + std::strerror(errno));
  std::fclose(file);
  try {
    if (!Imf::isOpenExrFile(path.c_str())) return bad_file(path, "not an OpenEXR file");
    return read_facts(path);
  } catch (const std::exception& e) {
    std::string why = e.what();
    for (char& c : why) {
      if (c == '\n') c = ' ';
    }
    return bad_file(path, "not a readable OpenEXR file: " + why);
  }
}

}  // namespace whittle
