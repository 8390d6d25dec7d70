// The cpu backend with everything it needs, for comparison with the oracle.
#pragma once

#include <memory>

#include "base/result.h"
#include "lower/lower.h"
#include "subdivide/subdivide.h"
#include "support/agreement.h"
#include "trace/cpu/cpu.h"

namespace whittle {

struct CpuSubject {
  Scene scene;
  CellTree cells;
  std::unique_ptr<CpuTracer> tracer;

  /// The cells are made where rays come, as in pictures, unless all are wanted at once.
  CpuSubject(const Model& model, const SubdivideSettings& settings, bool eager = false) {
    Result<Scene> lowered = lower(model);
    WHITTLE_CHECK(lowered);
    scene = *std::move(lowered);
    cells = eager ? subdivide(scene, settings) : open_cells(scene, settings);
    tracer = make_cpu_tracer(scene, cells, settings.threads);
  }
  CpuSubject(const CpuSubject&) = delete;
};

}  // namespace whittle
