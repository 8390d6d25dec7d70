#include "image/exr.h"

#include <fcntl.h>
#include <half.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "image/exr_calls.h"
#include "image/srgb.h"

namespace whittle {
namespace {

static_assert(sizeof(Hit::id) == sizeof(unsigned int));

/// Where each fact lies in a Hit, and what the file calls it.
struct FactChannel {
  const char* name;
  exr_pixel_type_t type;
  size_t offset;
};

constexpr FactChannel kFactChannels[] = {
    {"Z", EXR_PIXEL_FLOAT, offsetof(Hit, distance)},
    {"N.X", EXR_PIXEL_FLOAT, offsetof(Hit, normal) + offsetof(Vec3f, x)},
    {"N.Y", EXR_PIXEL_FLOAT, offsetof(Hit, normal) + offsetof(Vec3f, y)},
    {"N.Z", EXR_PIXEL_FLOAT, offsetof(Hit, normal) + offsetof(Vec3f, z)},
    {"id", EXR_PIXEL_UINT, offsetof(Hit, id)},
};
constexpr const char* kColorChannels[] = {"R", "G", "B", "A"};

/// A pixel's linear, premultiplied colour.
using HalfColor = std::array<imath_half_bits_t, 4>;

// What is wrong is told by the functions' results; the library would write to standard error.
void say_nothing(exr_const_context_t, exr_result_t, const char*) {}

// A chunk that unpacks to less than it should leaves the rest of the library's memory as it was.
void* get_zeros(size_t bytes) {
  return std::calloc(1, bytes);
}

exr_context_initializer_t quiet() {
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.error_handler_fn = say_nothing;
  how.alloc_fn = get_zeros;
  how.free_fn = std::free;
  return how;
}

/// A file that is written or read. It is closed when it goes.
struct Context {
  ExrCalls exr;
  exr_context_t handle = nullptr;

  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { close(); }

  exr_result_t close() {
    return handle != nullptr ? exr.exr_finish(&handle) : exr_result_t(EXR_ERR_SUCCESS);
  }
};

constexpr const char* kNoLibrary = "OpenEXR is not there (" WHITTLE_OPENEXR ")";

int64_t append(exr_const_context_t, void* file, const void* bytes, uint64_t count, uint64_t offset,
               exr_stream_error_func_ptr_t) {
  auto& text = *static_cast<std::string*>(file);
  try {
    if (text.size() < offset + count) text.resize(offset + count);
  } catch (const std::bad_alloc&) {
    return -1;  // the library is written in C
  }
  std::memcpy(text.data() + offset, bytes, count);
  return int64_t(count);
}

/// Packs and compresses the rows of the picture that a chunk of the file holds.
class ChunkEncoder {
 public:
  ChunkEncoder(const Context& file, const Frame& frame, const Picture& picture)
      : file_(file), frame_(frame), picture_(picture) {
    for (int i = 0; i < 256; ++i) decoded_[i] = linear_from_srgb(float(i) / 255);
  }

  /// The chunk that begins with row y. False if the library refuses.
  bool encode(int y, std::string& bytes) const {
    exr_chunk_info_t chunk;
    if (file_.exr.exr_write_scanline_chunk_info(file_.handle, 0, y, &chunk) != 0) return false;
    const size_t width = size_t(frame_.width), first = size_t(y) * width;
    const std::vector<HalfColor> colors = linear_colors(first, width * size_t(chunk.height));
    exr_encode_pipeline_t pipe;
    bool done = file_.exr.exr_encoding_initialize(file_.handle, 0, &chunk, &pipe) == 0;
    if (!done) return false;
    for (int c = 0; c < pipe.channel_count; ++c) place(first, colors, pipe.channels[c]);
    done = file_.exr.exr_encoding_choose_default_routines(file_.handle, 0, &pipe) == 0;
    // Chunks must be written in order; that is done afterwards.
    pipe.yield_until_ready_fn = nullptr;
    pipe.write_fn = nullptr;
    done = done && file_.exr.exr_encoding_run(file_.handle, 0, &pipe) == 0;
    if (done) {
      // What became no smaller is stored as it was. The library before 3.4.8 forgets that where it
      // is just as large (its issue 2306).
      const bool is_smaller = pipe.compressed_bytes < pipe.packed_bytes;
      bytes.assign(
          static_cast<const char*>(is_smaller ? pipe.compressed_buffer : pipe.packed_buffer),
          is_smaller ? pipe.compressed_bytes : pipe.packed_bytes);
    }
    file_.exr.exr_encoding_destroy(file_.handle, &pipe);
    return done;
  }

 private:
  std::vector<HalfColor> linear_colors(size_t first, size_t count) const {
    std::vector<HalfColor> colors(count);
    for (size_t i = 0; i < count; ++i) {
      const uint8_t* rgba = &picture_.rgba[4 * (first + i)];
      const float alpha = float(rgba[3]) / 255;
      for (size_t k = 0; k < 3; ++k) {
        colors[i][k] = imath_float_to_half(decoded_[rgba[k]] * alpha);
      }
      colors[i][3] = imath_float_to_half(alpha);
    }
    return colors;
  }

  /// Where the channel's values are.
  void place(size_t first, const std::vector<HalfColor>& colors,
             exr_coding_channel_info_t& channel) const {
    const std::string_view name = channel.channel_name;
    for (size_t k = 0; k < std::size(kColorChannels); ++k) {
      if (name != kColorChannels[k]) continue;
      channel.encode_from_ptr = reinterpret_cast<const uint8_t*>(&colors[0][k]);
      channel.user_pixel_stride = sizeof(HalfColor);
    }
    for (const FactChannel& fact : kFactChannels) {
      if (name != fact.name) continue;
      channel.encode_from_ptr = reinterpret_cast<const uint8_t*>(&frame_.hits[first]) + fact.offset;
      channel.user_pixel_stride = sizeof(Hit);
    }
    channel.user_line_stride = channel.user_pixel_stride * frame_.width;
  }

  const Context& file_;
  const Frame& frame_;
  const Picture& picture_;
  float decoded_[256];
};

/// The header of a file with those channels. 0, or the library's error.
exr_result_t begin_file(const Context& file, int width, int height) {
  int part = 0;
  exr_result_t failed = file.exr.exr_add_part(file.handle, nullptr, EXR_STORAGE_SCANLINE, &part);
  if (failed == 0) {
    failed = file.exr.exr_initialize_required_attr_simple(file.handle, part, width, height,
                                                          EXR_COMPRESSION_ZIP);
  }
  const auto add = [&](const char* name, exr_pixel_type_t type) {
    if (failed != 0) return;
    failed =
        file.exr.exr_add_channel(file.handle, part, name, type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
  };
  for (const char* name : kColorChannels) add(name, EXR_PIXEL_HALF);
  for (const FactChannel& fact : kFactChannels) add(fact.name, fact.type);
  return failed != 0 ? failed : file.exr.exr_write_header(file.handle);
}

/// All chunks, then the table of where they are.
exr_result_t write_chunks(Context& file, const std::vector<std::string>& chunks, int rows) {
  for (size_t i = 0; i < chunks.size(); ++i) {
    if (const exr_result_t failed = file.exr.exr_write_scanline_chunk(
            file.handle, 0, int(i) * rows, chunks[i].data(), chunks[i].size());
        failed != 0) {
      return failed;
    }
  }
  return file.close();
}

Error bad_file(const std::string& path, const std::string& why) {
  return {ErrorKind::kInput, path + ": " + why};
}

const char* type_name(exr_pixel_type_t type) {
  return type == EXR_PIXEL_UINT ? "uint" : type == EXR_PIXEL_HALF ? "half" : "float";
}

/// Why the channels are not those of whittle's files; empty if they are.
std::string wrong_channels(const exr_attr_chlist_t& channels) {
  for (const FactChannel& fact : kFactChannels) {
    const exr_attr_chlist_entry_t* found = nullptr;
    for (int i = 0; i < channels.num_channels && found == nullptr; ++i) {
      if (std::strcmp(channels.entries[i].name.str, fact.name) == 0) found = &channels.entries[i];
    }
    if (found == nullptr) {
      return std::string("no channel ") + fact.name +
             "; not a file of facts, as whittle writes them";
    }
    if (found->pixel_type != fact.type || found->x_sampling != 1 || found->y_sampling != 1) {
      return std::string("channel ") + fact.name + " must be " + type_name(fact.type) +
             " at every pixel";
    }
  }
  return {};
}

struct CloseDescriptor {
  int descriptor;
  ~CloseDescriptor() { ::close(descriptor); }
};

int64_t size_of_file(exr_const_context_t, void* descriptor) {
  struct stat status {};
  return ::fstat(*static_cast<int*>(descriptor), &status) == 0 ? int64_t(status.st_size) : -1;
}

int64_t read_file(exr_const_context_t, void* descriptor, void* bytes, uint64_t count,
                  uint64_t offset, exr_stream_error_func_ptr_t) {
  uint64_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(*static_cast<int*>(descriptor), static_cast<char*>(bytes) + done,
                                count - done, off_t(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += uint64_t(got);
  }
  return int64_t(done);
}

/// Reads a frame's rows, chunk by chunk.
class ChunkDecoder {
 public:
  ChunkDecoder(const Context& file, Frame& frame, int first_y)
      : file_(file), frame_(frame), first_y_(first_y) {}
  ~ChunkDecoder() {
    if (begun_) file_.exr.exr_decoding_destroy(file_.handle, &pipe_);
  }
  ChunkDecoder(const ChunkDecoder&) = delete;
  ChunkDecoder& operator=(const ChunkDecoder&) = delete;

  /// The chunk that begins with that row of the frame. 0, or the library's error.
  exr_result_t decode(int row) {
    const ExrCalls& exr = file_.exr;
    exr_chunk_info_t chunk;
    exr_result_t failed = exr.exr_read_scanline_chunk_info(file_.handle, 0, first_y_ + row, &chunk);
    if (failed != 0) return failed;
    failed = begun_ ? exr.exr_decoding_update(file_.handle, 0, &chunk, &pipe_)
                    : exr.exr_decoding_initialize(file_.handle, 0, &chunk, &pipe_);
    if (failed != 0) return failed;
    const bool is_first = !std::exchange(begun_, true);
    for (int c = 0; c < pipe_.channel_count; ++c) {
      if (!place(row, pipe_.channels[c])) return EXR_ERR_CORRUPT_CHUNK;
    }
    if (is_first) failed = exr.exr_decoding_choose_default_routines(file_.handle, 0, &pipe_);
    return failed != 0 ? failed : exr.exr_decoding_run(file_.handle, 0, &pipe_);
  }

 private:
  /// Where the channel's values go; those of other channels nowhere. False if there is no room.
  bool place(int row, exr_coding_channel_info_t& channel) {
    channel.decode_to_ptr = nullptr;
    for (const FactChannel& fact : kFactChannels) {
      if (std::strcmp(channel.channel_name, fact.name) != 0) continue;
      if (channel.width != frame_.width || channel.height > frame_.height - row) return false;
      channel.decode_to_ptr =
          reinterpret_cast<uint8_t*>(&frame_.hits[size_t(row) * size_t(frame_.width)]) +
          fact.offset;
      channel.user_data_type = uint16_t(fact.type);
      channel.user_bytes_per_element = 4;
      channel.user_pixel_stride = sizeof(Hit);
      channel.user_line_stride = int32_t(sizeof(Hit)) * frame_.width;
    }
    return true;
  }

  const Context& file_;
  Frame& frame_;
  int first_y_;
  bool begun_ = false;
  exr_decode_pipeline_t pipe_ = EXR_DECODE_PIPELINE_INITIALIZER;
};

/// What the header of an opened file is about, and the facts.
Result<Frame> read_facts(const Context& file, const std::string& path) {
  const ExrCalls& exr = file.exr;
  const auto unreadable = [&](exr_result_t failed) {
    return bad_file(path, std::string("not a readable OpenEXR file: ") +
                              exr.exr_get_default_error_message(failed));
  };
  exr_storage_t storage{};
  const exr_attr_chlist_t* channels = nullptr;
  exr_attr_box2i_t window{};
  int32_t rows = 0;
  exr_result_t failed = exr.exr_get_storage(file.handle, 0, &storage);
  if (failed == 0 && storage != EXR_STORAGE_SCANLINE) {
    return bad_file(path, "not stored in rows; not a file of facts, as whittle writes them");
  }
  if (failed == 0) failed = exr.exr_get_channels(file.handle, 0, &channels);
  if (failed == 0) failed = exr.exr_get_data_window(file.handle, 0, &window);
  if (failed == 0) failed = exr.exr_get_scanlines_per_chunk(file.handle, 0, &rows);
  if (failed != 0) return unreadable(failed);
  if (std::string wrong = wrong_channels(*channels); !wrong.empty()) return bad_file(path, wrong);
  const int64_t width = int64_t(window.max.x) - window.min.x + 1;
  const int64_t height = int64_t(window.max.y) - window.min.y + 1;
  // The header of a broken file may claim any size.
  constexpr int64_t kMaxSide = 1 << 16, kMaxPixels = int64_t(1) << 28;
  if (rows <= 0 || width <= 0 || height <= 0 || width > kMaxSide || height > kMaxSide ||
      width * height > kMaxPixels) {
    return bad_file(path, "the picture is empty or too large");
  }
  Frame frame{int(width), int(height)};
  ChunkDecoder decoder(file, frame, window.min.y);
  for (int row = 0; row < frame.height; row += rows) {
    if (failed = decoder.decode(row); failed != 0) return unreadable(failed);
  }
  return frame;
}

}  // namespace

Result<std::string> encode_exr(const Frame& frame, const Picture& picture, const Workers* workers) {
  WHITTLE_CHECK(frame.width > 0 && frame.height > 0);
  WHITTLE_CHECK(frame.width == picture.width && frame.height == picture.height);
  std::string bytes;
  Context file;
  if (!file.exr.load()) return Error{ErrorKind::kMachine, kNoLibrary};
  exr_context_initializer_t how = quiet();
  how.user_data = &bytes;
  how.write_fn = append;
  exr_result_t failed =
      file.exr.exr_start_write(&file.handle, "picture", EXR_WRITE_FILE_DIRECTLY, &how);
  if (failed == 0) failed = begin_file(file, frame.width, frame.height);
  int32_t rows = 0;
  if (failed == 0) failed = file.exr.exr_get_scanlines_per_chunk(file.handle, 0, &rows);
  if (failed == 0) {
    std::vector<std::string> chunks((size_t(frame.height) + size_t(rows) - 1) / size_t(rows));
    const ChunkEncoder encoder(file, frame, picture);
    for_parts(workers, chunks.size(), 1, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) {
        // What the library could not do is missing when it is written.
        if (!encoder.encode(int(i) * rows, chunks[i])) chunks[i].clear();
      }
    });
    failed = write_chunks(file, chunks, rows);
  }
  if (failed == 0) return bytes;
  return Error{ErrorKind::kMachine, file.exr.exr_get_default_error_message(failed)};
}

Result<Frame> read_exr(const std::string& path) {
  int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return bad_file(path, std::string("cannot read: ") + std::strerror(errno));
  const CloseDescriptor closes{descriptor};
  char magic[4] = {};
  if (::pread(descriptor, magic, sizeof magic, 0) != sizeof magic ||
      std::memcmp(magic, "\x76\x2f\x31\x01", sizeof magic) != 0) {
    return bad_file(path, "not an OpenEXR file");
  }
  Context file;
  if (!file.exr.load()) return Error{ErrorKind::kMachine, path + ": " + kNoLibrary};
  exr_context_initializer_t how = quiet();
  how.user_data = &descriptor;
  how.read_fn = read_file;
  how.size_fn = size_of_file;
  // No broken file is searched for what may be left of it.
  how.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
  if (const exr_result_t failed = file.exr.exr_start_read(&file.handle, path.c_str(), &how);
      failed != 0) {
    return bad_file(path, std::string("not a readable OpenEXR file: ") +
                              file.exr.exr_get_default_error_message(failed));
  }
  return read_facts(file, path);
}

}  // namespace whittle
