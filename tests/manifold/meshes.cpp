// Writes meshes for Manifold to judge: of files, of the scenes with coincident faces as they are
// written, turned and mirrored, and of random trees.
//
//     manifold_meshes FOLDER FILE.csg...
//
// A line of FOLDER/index.tsv names each of them, and tells its volume and its surface.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "boundary/write_solid.h"
#include "coincident/scenes.h"
#include "coincident/turned.h"
#include "host/read_file.h"
#include "support/mesh_checks.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

class Writer {
 public:
  explicit Writer(std::string folder) : folder_(std::move(folder)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    index_.open(folder_ + "/index.tsv");
  }

  /// Models that have no mesh (empty ones, without end, true curves) are not written.
  void add(const std::string& name, const Model& model) {
    const Workers workers(0);
    const Result<SolidMesh> mesh = solid_of(model, workers);
    if (!mesh) return;
    std::ofstream(folder_ + "/" + name + ".off", std::ios::binary)
        << write_solid(*mesh, SolidFormat::kOff, workers)->bytes;
    index_ << fmt::format("{}\t{}\t{}\n", name, volume(*mesh), surface(*mesh));
    ++count_;
  }
  size_t count() const { return count_; }

 private:
  std::string folder_;
  std::ofstream index_;
  size_t count_ = 0;
};

void add_scenes(Writer& writer) {
  for (const auto& chapter : {flush_scenes, abutting_scenes, body_scenes, curved_scenes,
                              facet_scenes, algebra_scenes, tolerance_scenes, menger_scenes}) {
    for (const CoincidentScene& scene : chapter()) {
      const Model model = facetted_model_of(scene.text);
      writer.add(scene.name, model);
      if (!scene.turns) continue;
      writer.add(scene.name + "_turned", turned(model, turn_of(model, false)));
      writer.add(scene.name + "_mirrored", turned(model, turn_of(model, true)));
    }
  }
}

void add_trees(Writer& writer) {
  constexpr uint64_t kTrees = 150;
  for (uint64_t seed = 1; seed <= kTrees; ++seed) {
    const bool coincident = seed % 3 != 0, nearly = seed % 3 == 2;
    writer.add(fmt::format("tree_{}", seed),
               facetted_model_of(random_tree(
                   seed, {.primitives = 14, .coincident = coincident, .nearly = nearly})));
  }
}

int run(int argc, char** argv) {
  Writer writer(argv[1]);
  for (int i = 2; i < argc; ++i) {
    const Result<Read> read = read_file(
        argv[i], {.reading = {.curves = Curves::kOpenscad2021}, .import_root = {}, .flatten = {}});
    if (!read) {
      fmt::print(stderr, "{}\n", read.error().message);
      return EXIT_FAILURE;
    }
    writer.add("file_" + std::filesystem::path(argv[i]).stem().string(), read->model);
  }
  add_scenes(writer);
  add_trees(writer);
  fmt::print("{} meshes\n", writer.count());
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  if (argc < 2) return EXIT_FAILURE;
  return whittle::run(argc, argv);
}
