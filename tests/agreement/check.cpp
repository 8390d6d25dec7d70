// Holds a backend to the oracle on given files, or on any number of random trees:
//
//   agreement_check FILE...                        three views each, several leaf sizes
//   agreement_check --seeds COUNT [--first SEED] [--coincident | --nearly]
//   agreement_check --raster specialised|unified [--floats] [--device DEVICE] ...
//                                                  vulkan-raster and not cpu, all its messages too
//
// Prints every model that differs with its first differing pixel; exit code 1 if any does.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "agreement/cpu_subject.h"
#include "agreement/raster_subject.h"
#include "boundary/closed_mesh.h"
#include "host/read_file.h"
#include "support/random_tree.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

/// Null: the cpu backend is held to the oracle.
using Device = std::shared_ptr<RasterDevice>;

struct Checked : AgreementReport {
  uint64_t in_doubt = 0;  ///< pixels that shaders in floats left to the second look
};

Checked check(const Device& device, const Model& model, std::span<const uint32_t> leaf_sizes,
              int width, int height) {
  const auto oracle = make_oracle_tracer(model);
  Checked sum;
  for (const uint32_t k : leaf_sizes) {
    SubdivideSettings settings;
    settings.leaf_size = k;
    if (device) {
      RasterSubject raster(device, model, settings);
      for (const Camera& camera : cameras_for(model, width, height)) {
        sum += check_agreement(model, *raster.tracer, *oracle, camera);
        sum.in_doubt += raster.tracer->stats().in_doubt;
      }
      if (!raster.tracer->status()) sum.first_difference = raster.tracer->status().error().message;
      continue;
    }
    CpuSubject cpu(model, settings);
    for (const Camera& camera : cameras_for(model, width, height))
      sum += check_agreement(model, *cpu.tracer, *oracle, camera);
    if (cpu.tracer->stats().disagreements > 0 && sum.first_difference.empty())
      sum.first_difference = "neighbouring cells disagree";
  }
  return sum;
}

bool report(const std::string& name, const Checked& r, bool always) {
  const bool bad = r.unexplained > 0 || r.ambiguous_unmatched > 0;
  if (bad || always)
    std::printf(
        "%s: %d pixels, %d hits, %d ambiguous, %d unexplained, %d unmatched, %llu in doubt\n",
        name.c_str(), r.pixels, r.hits, r.ambiguous, r.unexplained, r.ambiguous_unmatched,
        static_cast<unsigned long long>(r.in_doubt));
  if (bad) std::printf("  %s\n", r.first_difference.c_str());
  return !bad;
}

int run(int argc, char** argv) {
  bool good = true, coincident = false, nearly = false;
  uint64_t seeds = 0, first = 1;
  std::vector<std::string> files;
  RasterSettings settings;
  settings.validate = true;
  settings.first_batch_ms = 0;
  bool wants_raster = false;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--seeds") && i + 1 < argc)
      seeds = std::strtoull(argv[++i], nullptr, 10);
    else if (!std::strcmp(argv[i], "--first") && i + 1 < argc)
      first = std::strtoull(argv[++i], nullptr, 10);
    else if (!std::strcmp(argv[i], "--coincident"))
      coincident = true;
    else if (!std::strcmp(argv[i], "--nearly"))
      coincident = nearly = true;
    else if (!std::strcmp(argv[i], "--floats"))
      settings.numbers = ShaderNumbers::kFloat;
    else if (!std::strcmp(argv[i], "--device") && i + 1 < argc)
      settings.device = argv[++i];
    else if (!std::strcmp(argv[i], "--raster") && i + 1 < argc) {
      wants_raster = true;
      settings.shaders =
          !std::strcmp(argv[++i], "unified") ? ShaderCases::kUnified : ShaderCases::kSpecialised;
    } else
      files.push_back(argv[i]);
  }
  Device device;
  if (wants_raster) {
    Result<Device> opened = open_raster_device(settings);
    if (!opened) {
      std::printf("%s\n", opened.error().message.c_str());
      return 1;
    }
    device = *std::move(opened);
    std::printf("%s\n", describe(*device).c_str());
  }
  FileOptions options;
  options.reading.closed_mesh = [](const Model& model, size_t&) {
    return closed_mesh(model, Workers(0));
  };
  for (const std::string& file : files) {
    const Result<Read> read = read_file(file, options);
    if (!read) {
      std::printf("%s\n", read.error().message.c_str());
      good = false;
      continue;
    }
    static constexpr uint32_t kLeafSizes[] = {2, 4, 6, 16};
    good &= report(file, check(device, read->model, kLeafSizes, 96, 72), true);
  }
  Checked sum;
  for (uint64_t seed = first; seed < first + seeds; ++seed) {
    const uint32_t k[] = {uint32_t(2 + seed % 8)};
    const Checked r = check(device,
                            model_of(random_tree(seed, {.primitives = 4 + int(seed % 24),
                                                        .coincident = coincident,
                                                        .nearly = nearly,
                                                        .halfspaces = seed % 5 == 0})),
                            k, 16, 16);
    good &= report("seed " + std::to_string(seed), r, false);
    sum += r;
    sum.in_doubt += r.in_doubt;
  }
  if (seeds > 0) report("all seeds", sum, true);
  if (device) {
    for (const std::string& message : validation_messages(*device)) {
      std::printf("%s\n", message.c_str());
      good = false;
    }
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  return whittle::run(argc, argv);
}
