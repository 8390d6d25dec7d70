#include "whittle/choices.h"

namespace whittle {
namespace {

constexpr Choice<Backend> kBackends[] = {{"auto", Backend::kAuto},
                                         {"cpu", Backend::kCpu},
                                         {"vulkan-raster", Backend::kVulkanRaster},
                                         {"oracle", Backend::kOracle}};
constexpr Choice<Pass> kPasses[] = {
    {"color", Pass::kColor}, {"depth", Pass::kDepth}, {"normal", Pass::kNormal}, {"id", Pass::kId}};
constexpr Choice<FileFormat> kFormats[] = {{"png", FileFormat::kPng}, {"exr", FileFormat::kExr}};
constexpr Choice<Style> kStyles[] = {{"studio", Style::kStudio},
                                     {"plain", Style::kPlain},
                                     {"blinn", Style::kBlinn},
                                     {"openscad", Style::kOpenscad}};
constexpr Choice<Quality> kQualities[] = {
    {"draft", Quality::kDraft}, {"good", Quality::kGood}, {"best", Quality::kBest}};
constexpr Choice<Curves> kCurves[] = {
    {"auto", Curves::kAuto}, {"facets", Curves::kFacets}, {"smooth", Curves::kSmooth}};
constexpr Choice<bool> kMatrices[] = {{"polished", true}, {"as-written", false}};
constexpr Choice<SplitRule> kSplits[] = {{"longest", SplitRule::kLongest},
                                         {"xyz", SplitRule::kXyz},
                                         {"octree", SplitRule::kOctree},
                                         {"cost", SplitRule::kCost}};
constexpr Choice<ShaderCases> kShaders[] = {{"specialised", ShaderCases::kSpecialised},
                                            {"unified", ShaderCases::kUnified}};
constexpr Choice<bool> kCulling[] = {{"on", true}, {"off", false}};
constexpr Choice<bool> kProjections[] = {
    {"perspective", false}, {"p", false}, {"orthogonal", true}, {"ortho", true}, {"o", true}};
constexpr Choice<NamedView> kNamedViews[] = {
    {"front", NamedView::kFront}, {"back", NamedView::kBack}, {"left", NamedView::kLeft},
    {"right", NamedView::kRight}, {"top", NamedView::kTop},   {"bottom", NamedView::kBottom},
    {"iso", NamedView::kIso}};
constexpr Choice<bool> kSmallCells[] = {{"trace", false}, {"ignore", true}};
constexpr Choice<CellView> kCellViews[] = {{"edges", CellView::kEdges},
                                           {"faces", CellView::kFaces}};

}  // namespace

Choices<Backend> backend_choices() {
  return kBackends;
}
Choices<Pass> pass_choices() {
  return kPasses;
}
Choices<FileFormat> format_choices() {
  return kFormats;
}
Choices<Style> style_choices() {
  return kStyles;
}
Choices<Quality> quality_choices() {
  return kQualities;
}
Choices<Curves> curves_choices() {
  return kCurves;
}
Choices<bool> matrices_choices() {
  return kMatrices;
}
Choices<SplitRule> split_choices() {
  return kSplits;
}
Choices<ShaderCases> shaders_choices() {
  return kShaders;
}
Choices<bool> culling_choices() {
  return kCulling;
}
Choices<bool> projection_choices() {
  return kProjections;
}
Choices<NamedView> named_view_choices() {
  return kNamedViews;
}
Choices<bool> small_cells_choices() {
  return kSmallCells;
}
Choices<CellView> cell_view_choices() {
  return kCellViews;
}

}  // namespace whittle
