#include "slice_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>

#include "base/box.h"
#include "base/workers.h"
#include "console.h"
#include "image/png.h"
#include "progress.h"
#include "shape_files.h"
#include "slice/pixel_coverage.h"
#include "slice/slicer.h"
#include "slice/write_layers.h"
#include "whittle/output.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

/// The corners' box; a point if there are none.
Box box_of(const SolidMesh& mesh) {
  Box box;
  for (const Vec3& corner : mesh.corners) box.include(corner);
  return box.is_empty() ? Box{{}, {}} : box;
}

Rect seen_from_above(const Box& box) {
  return {{box.lo.x, box.lo.y}, {box.hi.x, box.hi.y}};
}

/// Counts layers as they are done.
class Share {
 public:
  Share(size_t all, Progress told) : all_(all), told_(std::move(told)) {}
  void add_one() {
    const size_t done = ++done_;
    if (told_) told_(double(done) / double(all_));
  }

 private:
  size_t all_;
  std::atomic<size_t> done_ = 0;
  Progress told_;
};

/// Whether a layer has anything in it.
Result<bool> write_svg(const Slicer& slicer, const Box& box, const SliceSettings& settings,
                       const Workers& workers, Share& share) {
  std::vector<SlicedLayer> layers(settings.heights.size());
  workers.for_parts(layers.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      layers[i] = {settings.heights[i], slicer.at(settings.heights[i])};
      share.add_one();
    }
  });
  const Status written =
      write_output(settings.paths[0], write_layers(layers, seen_from_above(box)));
  if (!written) return written.error();
  return std::ranges::any_of(layers, [](const SlicedLayer& layer) { return !layer.loops.empty(); });
}

/// White where the solid is.
Picture picture_of(const std::vector<Contour>& loops, const PixelFrame& frame) {
  Picture picture(frame.width, frame.height);
  cover_pixels(loops, frame, [&picture](int y, std::span<const double> shares) {
    uint8_t* to = picture.at(0, y);
    for (const double covered : shares) {
      std::fill_n(to, 3, to_8_bits(float(covered)));
      to += 4;
    }
  });
  return picture;
}

/// The same of pictures.
Result<bool> write_pngs(const Slicer& slicer, const PixelFrame& frame,
                        const SliceSettings& settings, const Workers& workers, Share& share) {
  std::atomic<bool> has_any = false, has_failed = false;
  std::mutex mutex;
  std::optional<Error> error;
  workers.for_parts(settings.heights.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last && !has_failed; ++i) {
      const std::vector<Contour> loops = slicer.at(settings.heights[i]);
      if (!loops.empty()) has_any = true;
      const Status written =
          write_output(settings.paths[i], encode_grey_png(picture_of(loops, frame)));
      if (!written) {
        const std::lock_guard lock(mutex);
        if (!error) error = written.error();
        has_failed = true;
      }
      share.add_one();
    }
  });
  if (error) return *error;
  return has_any.load();
}

/// As many as have room for their pictures in a gigabyte, but one at least.
int threads_for_pictures(const SliceSettings& settings, size_t threads) {
  constexpr size_t kRoom = size_t(1) << 30, kBytesOfPixel = 8;  // a picture and its file
  const size_t each = kBytesOfPixel * size_t(settings.width) * size_t(settings.height);
  return int(std::clamp(kRoom / each, size_t(1), threads));
}

}  // namespace

Status write_slices(const Model& model, const SliceSettings& settings) {
  ProgressLine progress(!settings.quiet, "evaluating");
  const Workers workers(settings.threads);
  const Result<SolidMesh> mesh =
      solid_or_nothing_of(model, workers, nullptr, {.progress = progress.share()});
  if (!mesh) return explain_curves(mesh.error(), model, settings.curves);
  const Box box = box_of(*mesh);
  PixelFrame frame;
  if (!settings.is_svg) {
    frame = frame_around(seen_from_above(box), settings.width, settings.height, settings.pixel);
    const Vec3 size = box.size();
    const double width = frame.pixel * frame.width, height = frame.pixel * frame.height;
    constexpr double kRounding = 1 + 1e-9;
    if (size.x > width * kRounding || size.y > height * kRounding) {
      return Error{ErrorKind::kInput,
                   fmt::format("{}: error: the solid is {:.6g} x {:.6g} mm, and {} x {} pixels of "
                               "{:.6g} mm are {:.6g} x {:.6g}",
                               model.file, size.x, size.y, frame.width, frame.height, frame.pixel,
                               width, height)};
    }
  }

  progress.stage("slicing");
  const Slicer slicer(*mesh);
  Share share(settings.heights.size(), progress.share());
  const Result<bool> has_any =
      settings.is_svg ? write_svg(slicer, box, settings, workers, share)
                      : write_pngs(slicer, frame, settings,
                                   Workers(threads_for_pictures(settings, workers.count())), share);
  if (!has_any) return has_any.error();
  if (*has_any || settings.quiet) return Done{};
  progress.without_line([&] {
    say(mesh->triangles.empty()
            ? fmt::format("{}: note: the solid is empty, and so are the layers", model.file)
            : fmt::format("{}: note: no layer meets the solid, which is from z = {:.6g} to {:.6g}",
                          model.file, box.lo.z, box.hi.z));
  });
  return Done{};
}

}  // namespace whittle
