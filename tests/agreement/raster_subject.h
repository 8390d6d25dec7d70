// The vulkan-raster backend with everything it needs, for comparison with the oracle. One device
// serves all subjects of a program; the validation layer listens.
#pragma once

#include <memory>
#include <string>

#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "trace/cpu/cpu.h"
#include "trace/vulkan/raster.h"

namespace whittle {

struct RasterSubject {
  Scene scene;
  CellTree cells;
  std::unique_ptr<RasterTracer> tracer;

  /// `eager`: all cells are refined before there are pictures.
  RasterSubject(std::shared_ptr<RasterDevice> device, const Model& model,
                const SubdivideSettings& settings, bool eager = false) {
    Result<Scene> lowered = lower(model);
    WHITTLE_CHECK(lowered);
    scene = *std::move(lowered);
    SubdivideSettings rules = settings;
    rules.margin = cell_margin(*device);
    cells = eager ? subdivide(scene, rules) : open_cells(scene, rules);
    Result<std::unique_ptr<RasterTracer>> made = make_raster_tracer(
        std::move(device), scene, cells, [this] { return make_cpu_tracer(scene, cells); });
    if (!made) std::fprintf(stderr, "%s\n", made.error().message.c_str());
    WHITTLE_CHECK(made);
    tracer = *std::move(made);
  }
  RasterSubject(const RasterSubject&) = delete;
};

}  // namespace whittle
