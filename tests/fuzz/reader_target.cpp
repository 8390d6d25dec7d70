// Any bytes given to the .csg reader, and what follows it cheaply: what is read must be well
// formed, what is refused must be refused in one line with a place, and both must be so again.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "boundary/closed_mesh.h"
#include "csg/read_csg.h"
#include "fuzz/require.h"
#include "fuzz/target.h"
#include "lower/lower.h"
#include "model/instances.h"
#include "shape/fragments.h"
#include "shape/shape.h"

namespace whittle {
namespace {

constexpr const char* kFile = "fuzz.csg";

/// Small enough for thousands of inputs a second, large enough to be reached and refused.
ReadOptions small_limits(Curves curves) {
  return {
      .curves = curves,
      .limits = {.bytes = 1 << 20, .depth = 3000, .nodes = 5000, .values = 20000, .facets = 3000},
      // Without a folder: no files are read.
      .outlines = true,
      .closed_mesh = [](const Model& model, size_t& pieces) {
        BoundaryStats stats;
        Result<TriangleMesh> mesh =
            closed_mesh(model, Workers(1),
                        {.cell_memory = 1 << 24, .pairs = 1'000'000, .pieces = 10'000}, &stats);
        pieces = stats.pieces;
        return mesh;
      }};
}

// Messages.

/// Takes a number from the front; 0 if there is none.
size_t take_number(std::string_view& text) {
  size_t number = 0, digits = 0;
  for (; digits < text.size() && text[digits] >= '0' && text[digits] <= '9' && digits < 18;
       ++digits)
    number = number * 10 + size_t(text[digits] - '0');
  text.remove_prefix(digits);
  return number;
}

bool take(std::string_view& text, std::string_view what) {
  if (!text.starts_with(what)) return false;
  text.remove_prefix(what.size());
  return true;
}

/// One line, and nothing in it that a terminal would obey.
bool is_plain_line(std::string_view text) {
  return !text.empty() && std::none_of(text.begin(), text.end(),
                                       [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; });
}

/// The length in bytes of a line of the text, counted from 1; none has any if it is beyond the end.
size_t line_length(std::string_view text, size_t line) {
  for (; line > 1; --line) {
    const size_t newline = text.find('\n');
    if (newline == std::string_view::npos) return std::string_view::npos;
    text.remove_prefix(newline + 1);
  }
  return std::min(text.find('\n'), text.size());
}

/// `fuzz.csg:line:column: KIND: ...`, the place being one of the text or just behind its line.
bool is_message(std::string_view message, std::string_view kind, std::string_view text) {
  if (!is_plain_line(message) || !take(message, kFile) || !take(message, ":")) return false;
  const size_t line = take_number(message);
  if (line == 0 || !take(message, ":")) return false;
  const size_t column = take_number(message);
  if (column == 0 || !take(message, ": ") || !take(message, kind) || !take(message, ": "))
    return false;
  // A byte order mark is no part of its line.
  const size_t length = line_length(text, line);
  return !message.empty() && length != std::string_view::npos && column <= length + 1;
}

/// Warnings beyond the first of a kind are counted in a line without a place.
bool is_warning(std::string_view message, std::string_view text) {
  if (is_message(message, "warning", text)) return true;
  if (!is_plain_line(message) || !take(message, kFile) || !take(message, ": warning: "))
    return false;
  return take_number(message) > 0 && take(message, " more times: ") && !message.empty();
}

// Is it the same again?

/// Everything that reading gave, as bytes.
class Digest {
 public:
  template <class T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }
  void text(const std::string& value) {
    number(value.size());
    bytes_ += value;
  }
  void vector(Vec3 v) {
    for (int i = 0; i < 3; ++i) number(v[i]);
  }
  void operator()(const Cube& s) { vector(s.size), number(s.center); }
  void operator()(const Sphere& s) { number(s.r), number(s.facets); }
  void operator()(const Cylinder& s) {
    number(s.h), number(s.r1), number(s.r2), number(s.center), number(s.facets);
  }
  void operator()(const Halfspace& s) { vector(s.n), number(s.d); }
  void operator()(const Polyhedron& s) {
    for (const Vec3 p : s.points) vector(p);
    for (const auto& face : s.faces) {
      number(face.size());
      for (const uint32_t corner : face) number(corner);
    }
    for (const Plane& plane : s.planes) vector(plane.n), number(plane.d);
  }
  void operator()(const Mesh& s) {
    if (!s.surface) return;
    for (const Vec3 p : s.surface->points) vector(p);
    for (const TriangleMesh::Triangle& t : s.surface->triangles) {
      for (const uint32_t corner : t.corners) number(corner);
      number(t.facet);
    }
    for (const Plane& plane : s.surface->facets) vector(plane.n), number(plane.d);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

std::string digest(const Result<Read>& read) {
  if (!read) return read.error().message;
  Digest d;
  const Model& model = read->model;
  for (const Node& node : model.nodes) {
    d.number(int(node.kind)), d.number(node.background), d.number(node.highlight);
    d.number(node.end), d.number(node.payload), d.number(node.where.line);
    d.number(node.where.column);
  }
  for (const Affine& map : model.transforms) {
    for (int i = 0; i < 3; ++i) d.vector(map.row[i]);
    d.vector(map.translation);
  }
  for (const Rgba& c : model.colors) d.number(c.r), d.number(c.g), d.number(c.b), d.number(c.a);
  for (const Primitive& primitive : model.primitives) {
    d.number(primitive.shape.index()), d.number(primitive.id);
    std::visit(d, primitive.shape);
  }
  d.number(model.statement_count);
  const FileView& view = model.view;
  for (const std::optional<Vec3>& v : {view.target, view.rotation_degrees})
    d.number(v.has_value()), d.vector(v.value_or(Vec3{}));
  for (const std::optional<double>& x : {view.distance, view.fov_degrees})
    d.number(x.has_value()), d.number(x.value_or(0));
  for (const std::string& warning : read->warnings) d.text(warning);
  d.text(read->unsupported ? read->unsupported->message : "");
  d.text(read->refusal);
  for (const WordCount& count : read->counts.words) d.text(count.word), d.number(count.count);
  return d.take();
}

// What was read.

void check_tree(const Model& model) {
  require(!model.nodes.empty() && model.nodes[0].end == model.nodes.size(), "no root");
  require(model.nodes[0].kind == NodeKind::kUnion, "the root is no union");
  size_t primitives = 0;
  for (uint32_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    require(node.end > i && node.end <= model.nodes.size(), "a node ends before it begins");
    uint32_t child = i + 1;
    while (child < node.end) child = model.nodes[child].end;
    require(child == node.end, "a child reaches out of its parent");
    require(node.where.line >= 1 && node.where.column >= 1, "a node without a place");
    switch (node.kind) {
      case NodeKind::kTransform:
        require(node.payload < model.transforms.size(), "a transform without its map");
        break;
      case NodeKind::kColor:
        require(node.payload < model.colors.size(), "a colour without its value");
        break;
      case NodeKind::kBody:
        require(node.payload > 0 && node.payload <= model.statement_count, "a body without an id");
        for (uint32_t k = i + 1; k < node.end; ++k) {
          require(model.nodes[k].kind != NodeKind::kPrimitive ||
                      model.primitives[model.nodes[k].payload].id == node.payload,
                  "a body with a part of another");
        }
        break;
      case NodeKind::kPrimitive:
        require(node.end == i + 1, "a primitive with children");
        require(node.payload == primitives++, "primitives out of order");
        break;
      case NodeKind::kLeaf:
      case NodeKind::kOperation:
        require(false, "a model that is not evaluated");
        break;
      default:
        require(node.payload == 0, "an operator with a payload");
    }
  }
  require(primitives == model.primitives.size(), "a primitive that no node names");
}

void check_outlines(const Model& model) {
  if (!model.drawing) return;
  for (const std::vector<Vec2>& outline : model.drawing->outlines) {
    require(outline.size() >= 3, "an outline without an inside");
    for (const Vec2 p : outline)
      require(std::isfinite(p.x) && std::isfinite(p.y), "an outline that is not finite");
  }
}

void check_primitives(const Model& model, const ReadOptions& limits) {
  // What is under `%` costs nothing, and so counts nothing.
  std::vector<uint8_t> is_solid(model.primitives.size(), 0);
  for (const Instance& instance : instances(model)) is_solid[instance.primitive] = 1;
  uint32_t last_id = 0;
  size_t facets = 0;
  for (size_t i = 0; i < model.primitives.size(); ++i) {
    const Primitive& primitive = model.primitives[i];
    // Parts of a body have one id.
    require(primitive.id >= last_id && primitive.id <= model.statement_count, "ids fall");
    last_id = primitive.id;
    if (const auto* s = std::get_if<Sphere>(&primitive.shape))
      require(s->facets == 0 || s->facets >= 3, "a sphere of two facets");
    if (const auto* s = std::get_if<Cylinder>(&primitive.shape))
      require(s->facets == 0 || s->facets >= 3, "a cylinder of two facets");
    if (const auto* s = std::get_if<Polyhedron>(&primitive.shape)) {
      for (const auto& face : s->faces)
        for (const uint32_t corner : face)
          require(corner < s->points.size(), "a face names a point that there is not");
    }
    if (is_empty(primitive.shape) || !is_flat(primitive.shape)) continue;
    const std::vector<Plane> planes = facet_planes(primitive.shape);
    facets += std::holds_alternative<Halfspace>(primitive.shape) ||
                      std::holds_alternative<Cube>(primitive.shape)
                  ? 0
                  : is_solid[i] * planes.size();
    for (const Plane& plane : planes)
      require(std::fabs(length(plane.n) - 1) < 1e-9, "a facet without a unit normal");
  }
  // Polyhedra are counted by the faces written, which may be more.
  require(facets <= limits.limits.facets, "more facets than the limit");
}

/// What stands right of the model in the data path and costs little.
void check_what_follows(const Model& model) {
  const std::vector<Instance> all = instances(model);
  for (const Instance& instance : all) {
    require(instance.node < model.nodes.size(), "an instance without a node");
    const Node& node = model.nodes[instance.node];
    require(node.kind == NodeKind::kPrimitive && node.payload == instance.primitive,
            "an instance of another node");
    if (instance.empty) {
      require(instance_box(model, instance).is_empty(), "nothing has a box");
      continue;
    }
    require(instance.world_from_object.is_finite(), "a solid under a map that is not finite");
  }
  require(appearances(model).size() == size_t(model.statement_count) + 1, "looks are missing");
  const Bounds b = bounds(model);
  require(b.box.is_empty() || b.box.is_finite(), "bounds that are not finite");
  require(b.bounded || !b.box.is_empty(), "an unbounded solid without a region");
  require(tolerance(b) >= 0 && std::isfinite(tolerance(b)), "no tolerance");

  const Result<Scene> scene = lower(model);
  require(bool(scene), "what is within the limits cannot be lowered");
  require(scene->formula.size() > 0, "no formula");
  for (const Token token : scene->formula) {
    const size_t most = token.is_group()                   ? scene->formula.size()
                        : token.kind() == TokenKind::kFace ? scene->faces.size() - 1
                                                           : scene->units.size() - 1;
    require(token.payload() <= most, "a token that names nothing");
  }
  for (const Face& face : scene->faces) {
    require(face.literal / 2 < scene->half_spaces.size(), "a face without a half-space");
    require(face.unit < scene->units.size(), "a face of nobody");
  }
  for (const Unit& unit : scene->units)
    require(size_t(unit.first_face) + unit.face_count <= scene->faces.size(), "faces are missing");
}

void check(std::string_view text) {
  // Three ways to read curves; the text itself says which, so that an input stays what it is.
  const ReadOptions limits = small_limits(Curves(text.size() % 3));
  const Result<Read> read = read_csg(text, kFile, limits);
  require(digest(read) == digest(read_csg(text, kFile, limits)), "read again it is another");
  ReadOptions in_pieces = limits;
  in_pieces.piece_bytes = 1 + text.size() % 50;
  in_pieces.threads = 1;
  require(digest(read) == digest(read_csg(text, kFile, in_pieces)), "in pieces it is another");
  if (!read) {
    const std::string& message = read.error().message;
    require(read.error().kind == ErrorKind::kInput, "a mistake of another kind: " + message);
    require(is_message(message, "error", text), "a message of another form: " + message);
    return;
  }
  for (const std::string& warning : read->warnings)
    require(is_warning(warning, text), "a warning of another form: " + warning);
  require(!read->unsupported || !read->warnings.empty(), "not understood, without a warning");
  check_tree(read->model);
  check_outlines(read->model);
  check_primitives(read->model, limits);
  check_what_follows(read->model);
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // What text() shows depends on the machine's fonts.
  if (text.find("text") != std::string_view::npos) return 0;
  whittle::check(text);
  return 0;
}
