// The reference backend: what every other backend is compared with.
//
// Double precision, every primitive of every ray in the primitive's own coordinates, all crossings
// sorted, the Boolean tree by definition. It uses the model alone, no half-spaces and no cells, and
// shares no arithmetic with the other backends. It is meant to be obviously right and never gets
// fast: a ray costs all primitives, always.
#pragma once

#include <memory>

#include "model/model.h"
#include "trace/tracer.h"

namespace whittle {

/// The tracer "oracle". `threads` <= 0 takes what the machine has. The model must outlive it.
std::unique_ptr<Tracer> make_oracle_tracer(const Model& model, int threads = 0);

}  // namespace whittle
