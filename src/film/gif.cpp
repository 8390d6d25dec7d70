#include <fmt/format.h>
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "film/film_writer.h"
#include "film/palette.h"

namespace whittle {
namespace {

constexpr int kNoTransparentColor = -1;

struct FreeColorMap {
  void operator()(ColorMapObject* map) const { GifFreeMapObject(map); }
};

class GifWriter : public FilmWriter {
 public:
  GifWriter(const FilmSettings& settings, ByteSink sink)
      : settings_(settings), sink_(std::move(sink)) {}
  ~GifWriter() override { close(); }
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;

  Status add(const Picture& picture) override {
    WHITTLE_CHECK(picture.width == settings_.width && picture.height == settings_.height);
    WHITTLE_CHECK(added_ < settings_.frames);
    if (!file_ && !begin()) return failure();
    IndexedPicture indexed = to_palette(picture, 256, settings_.with_alpha);
    if (!put_frame(indexed)) return failure();
    ++added_;
    return Done{};
  }

  Status finish() override {
    WHITTLE_CHECK(added_ == settings_.frames);
    return close() ? Status(Done{}) : Status(failure());
  }

 private:
  /// Called by the library, which passes on that it failed.
  static int put(GifFileType* file, const GifByteType* bytes, int size) {
    auto& self = *static_cast<GifWriter*>(file->UserData);
    if (self.refused_) return 0;
    const Status put =
        self.sink_({reinterpret_cast<const char*>(bytes), static_cast<size_t>(size)});
    if (put) return size;
    self.refused_ = put.error();
    return 0;
  }

  /// What the sink said, or the library.
  Error failure() const {
    if (refused_) return *refused_;
    const char* const why = GifErrorString(file_ ? file_->Error : error_);
    return {ErrorKind::kMachine, fmt::format("cannot make a GIF: {}", why ? why : "unknown")};
  }

  bool close() {
    if (!file_) return true;
    return EGifCloseFile(std::exchange(file_, nullptr), &error_) == GIF_OK;
  }

  bool begin() {
    file_ = EGifOpen(this, put, &error_);
    if (!file_) return false;
    EGifSetGifVersion(file_, true);
    constexpr int kDepth = 8;
    if (EGifPutScreenDesc(file_, settings_.width, settings_.height, kDepth, 0, nullptr) != GIF_OK)
      return false;
    // Netscape's block, which says how often it is played: 0 is for ever.
    constexpr std::array<GifByteType, 3> kForEver = {1, 0, 0};
    return EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
           EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0") == GIF_OK &&
           EGifPutExtensionBlock(file_, int(kForEver.size()), kForEver.data()) == GIF_OK &&
           EGifPutExtensionTrailer(file_) == GIF_OK;
  }

  /// Hundredths of a second that the next frame is shown: the sum of them never drifts.
  int delay() const {
    const auto at = [&](int frame) { return std::lround(100.0 * frame / settings_.fps); };
    return int(at(added_ + 1) - at(added_));
  }

  bool put_frame(IndexedPicture& indexed) {
    const GraphicsControlBlock control{
        .DisposalMode = settings_.with_alpha ? DISPOSE_BACKGROUND : DISPOSE_DO_NOT,
        .UserInputFlag = false,
        .DelayTime = delay(),
        .TransparentColor = settings_.with_alpha ? 0 : kNoTransparentColor};
    std::array<GifByteType, 4> block{};
    EGifGCBToExtension(&control, block.data());
    if (EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, int(block.size()), block.data()) != GIF_OK)
      return false;
    // Their number is a power of two.
    indexed.colors.resize(std::max<size_t>(2, std::bit_ceil(indexed.colors.size())));
    std::array<GifColorType, 256> colors{};
    for (size_t i = 0; i < indexed.colors.size(); ++i)
      colors[i] = {indexed.colors[i].r, indexed.colors[i].g, indexed.colors[i].b};
    const std::unique_ptr<ColorMapObject, FreeColorMap> map(
        GifMakeMapObject(int(indexed.colors.size()), colors.data()));
    if (!map) {
      refused_ = Error{ErrorKind::kMachine, "cannot make a GIF: out of memory"};
      return false;
    }
    if (EGifPutImageDesc(file_, 0, 0, settings_.width, settings_.height, false, map.get()) !=
        GIF_OK)
      return false;
    for (int y = 0; y < settings_.height; ++y) {
      GifPixelType* const row = &indexed.indices[size_t(y) * size_t(settings_.width)];
      if (EGifPutLine(file_, row, settings_.width) != GIF_OK) return false;
    }
    return true;
  }

  FilmSettings settings_;
  ByteSink sink_;
  GifFileType* file_ = nullptr;
  int error_ = 0;                 ///< the library's, where there is no file
  std::optional<Error> refused_;  ///< by the sink
  int added_ = 0;
};

}  // namespace

std::unique_ptr<FilmWriter> make_gif_writer(const FilmSettings& settings, ByteSink sink) {
  WHITTLE_CHECK(settings.fps <= kMostFpsOfGif);
  return std::make_unique<GifWriter>(settings, std::move(sink));
}

}  // namespace whittle
