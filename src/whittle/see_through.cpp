#include "whittle/see_through.h"

#include <utility>

namespace whittle {

Result<std::unique_ptr<SeeThrough>> SeeThrough::make(const Model& model,
                                                     std::shared_ptr<const Layers> layers,
                                                     std::span<const Appearance> looks,
                                                     const RendererSettings& settings) {
  std::unique_ptr<SeeThrough> made(new SeeThrough);
  made->layers_ = std::move(layers);
  const Layers& all = *made->layers_;
  made->looks_.assign(looks.begin(), looks.end());
  Box around = bounds(model).box;
  // One table of looks for each kind of layer, since ids are the same.
  uint32_t ghosts = 0, highlights = 0;
  const auto add_looks = [&](const std::vector<Appearance>& more) {
    const auto first = uint32_t(made->looks_.size());
    made->looks_.insert(made->looks_.end(), more.begin(), more.end());
    return first;
  };
  for (const Layer& layer : all.see_through) {
    if (layer.kind == LayerKind::kGhost && ghosts == 0)
      ghosts = add_looks(ghost_looks(*model.background));
    if (layer.kind == LayerKind::kHighlight && highlights == 0)
      highlights = add_looks(highlight_looks(layer.model));
    around = unite(around, bounds(layer.model).box);
  }
  made->tolerance_ = tolerance({.box = around, .bounded = true});

  RendererSettings own = settings;
  if (own.backend != Backend::kOracle) own.backend = Backend::kCpu;
  own.device.clear();
  own.part_colors = own.ghosts = own.thrown_together = false;
  own.subdivide.memory /= all.see_through.size() + 1;
  const auto open = [&](const Model& part, Part& into) -> Status {
    Result<Renderer> renderer = Renderer::make(part, own);
    if (!renderer) return renderer.error();
    into.renderer.emplace(*std::move(renderer));
    return Done{};
  };
  if (!all.is_whole) {
    if (Status opened = open(all.opaque, made->opaque_); !opened) return opened.error();
  }
  for (const Layer& layer : all.see_through) {
    Part& part = made->parts_.emplace_back();
    part.is_ghost = layer.kind != LayerKind::kPart;
    part.first_look = layer.kind == LayerKind::kGhost       ? ghosts
                      : layer.kind == LayerKind::kHighlight ? highlights
                                                            : 0;
    if (Status opened = open(layer.model, part); !opened) return opened.error();
  }
  return made;
}

Result<Frame> SeeThrough::trace(Part& part, const Camera& camera) {
  if (!part.is_prepared) {
    if (Status prepared = part.renderer->prepare(camera); !prepared) return prepared.error();
    part.is_prepared = true;
  }
  return part.renderer->trace(camera);
}

Result<SeeThrough::Sight> SeeThrough::look_from(const Camera& camera, const ShadeSettings& settings,
                                                Tracer& whole, const Frame& frame) {
  Sight sight;
  sight.opaque = &whole, sight.frame = &frame;
  if (opaque_.renderer) {
    Result<Frame> seen = trace(opaque_, camera);
    if (!seen) return seen.error();
    frame_ = *std::move(seen);
    sight.opaque = &opaque_.renderer->tracer(), sight.frame = &frame_;
  }
  std::vector<VeilLayer> veils;
  for (Part& part : parts_) {
    Result<Frame> seen = trace(part, camera);
    if (!seen) return seen.error();
    veils.push_back({&part.renderer->tracer(), *std::move(seen), part.first_look, part.is_ghost});
  }
  ShadeSettings look = settings;
  look.cut_faces = nullptr;
  look.lone_primitive.reset();
  sight.veil = std::make_unique<Veil>(std::move(veils), looks_, camera, look, tolerance_);
  return sight;
}

}  // namespace whittle
