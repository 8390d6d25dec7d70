// whittle compare A.exr B.exr: do two pictures state the same facts?
#include "image/compare.h"

#include <string>

#include "base/box.h"
#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "image/exr.h"
#include "option_group.h"
#include "whittle/output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle compare",
    "Compares the facts (hit, id, distance, normal) of two pictures; colours do not\n"
    "count. Says where they differ.",
    "A.exr B.exr [options]",
    "Examples:\n"
    "  whittle compare before.exr after.exr\n"
    "  whittle compare cpu.exr oracle.exr --distance 1e-4 -o difference.png\n\n"
    "Exit codes: 0 equal, 1 different or bad input, 2 bad usage, 3 refused by the\n"
    "machine."};

constexpr int kExitDifferent = 1;

Status write_difference(const std::string& path, const Frame& a, const Frame& b,
                        const CompareSettings& settings) {
  const Picture picture = difference_picture(a, b, settings);
  if (picture.rgba.empty()) {
    return Error{ErrorKind::kInput,
                 path + ": not written: pictures of different size have no difference picture"};
  }
  const Result<std::string> bytes = encode(FileFormat::kPng, a, picture, false, path);
  if (!bytes) return bytes.error();
  return write_output(path, *bytes);
}

}  // namespace

int compare_command(Arguments arguments) {
  CommandLine line(kHelp);
  std::string file_a, file_b, picture;
  CompareSettings settings;
  bool quiet = false;
  line.add_required("A.exr", file_a);
  line.add_required("B.exr", file_b);
  OptionGroup what(line.app(), "What still counts as equal"), output(line.app(), "Output");
  what.add_number("--distance", "SHARE", settings.distance_relative, 0, kInfinity,
                  "of the distance (1e-5)");
  what.add_number("--distance-floor", "UNITS", settings.distance_floor, 0, kInfinity,
                  "distances below count as this (0)");
  what.add_number("--normal", "DEGREES", settings.normal_degrees, 0, 180,
                  "angle between the normals (0.5)");
  output.add_text("-o", "PNG",
                  "a picture of the differences; hit red, id orange,\n"
                  "distance violet, normal blue",
                  [&](const std::string& path) {
                    const Result<FileFormat> format = format_of(path);
                    if (!format || *format != FileFormat::kPng) refuse("-o", "wants a .png file");
                    picture = path;
                  });
  output.add_flag("-q,--quiet", quiet, "the exit code says it all");
  if (const std::optional<int> code = line.parse(arguments)) return *code;

  for (const std::string& file : {file_a, file_b}) {
    if (picture.empty()) break;
    const Status possible = check_not_input(picture, file);
    if (!possible) return report(possible.error());
  }
  const Result<Frame> a = read_exr(file_a);
  if (!a) return report(a.error());
  const Result<Frame> b = read_exr(file_b);
  if (!b) return report(b.error());
  const Comparison comparison = compare(*a, *b, settings);
  if (!quiet) {
    if (const int code = print(describe(comparison) + "\n"); code != kExitDone) return code;
  }
  if (!picture.empty()) {
    const Status written = write_difference(picture, *a, *b, settings);
    if (!written) return report(written.error());
  }
  return comparison.equal() ? kExitDone : kExitDifferent;
}

}  // namespace whittle
