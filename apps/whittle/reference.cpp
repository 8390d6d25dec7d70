#include "reference.h"

#include <fmt/format.h>

#include <utility>

#include "image/compare.h"
#include "image/compare_pictures.h"
#include "image/exr.h"
#include "image/png.h"
#include "whittle/output.h"

namespace whittle {
namespace {

struct Verdict {
  double share = 0;
  std::string words;
  Picture difference;
};

Result<Verdict> compare_colors(const std::string& file, Picture picture, bool with_alpha) {
  const Result<Picture> reference = read_png(file);
  if (!reference) return reference.error();
  for (size_t i = 3; !with_alpha && i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  const PictureComparison comparison = compare(picture, *reference);
  return Verdict{comparison.share(), describe(comparison), difference_picture(picture, *reference)};
}

Result<Verdict> compare_facts(const std::string& file, const Frame& frame) {
  const Result<Frame> reference = read_exr(file);
  if (!reference) return reference.error();
  const Comparison comparison = compare(frame, *reference);
  const double share =
      comparison.same_size() ? double(comparison.differing) / double(comparison.pixels) : 1;
  // The numbers are enough here; `whittle compare` tells the rest.
  const std::string words = describe(comparison);
  return Verdict{share, words.substr(0, words.find('\n')), difference_picture(frame, *reference)};
}

}  // namespace

bool ReferenceArguments::wants_picture() const {
  return file && *format_of(*file) == FileFormat::kPng;
}

void add_reference_options(CLI::App& app, ReferenceArguments& reference) {
  OptionGroup group(app, "Comparing");
  group.add_text("--reference", "FILE",
                 "exit code 1 if the picture is not that .png any more,\n"
                 "or its facts not those of that .exr",
                 [&](const std::string& path) { reference.file = path; });
  group.add_number("--reference-threshold", "SHARE", reference.threshold, 0, 1,
                   "of all pixels that may differ, 0 to 1 (0)");
  group.add_text("--reference-difference", "PNG", "a picture of what differs, red",
                 [&](const std::string& path) { reference.difference = path; });
}

Status check_reference(const ReferenceArguments& reference) {
  if (!reference.file) {
    if (!reference.difference) return Done{};
    return Error{ErrorKind::kUsage, "--reference-difference is for --reference FILE"};
  }
  if (const Result<FileFormat> format = format_of(*reference.file); !format) {
    return Error{ErrorKind::kUsage, "--reference " + format.error().message};
  }
  if (!reference.difference) return Done{};
  const Result<FileFormat> format = format_of(*reference.difference);
  if (format && *format == FileFormat::kPng) return Done{};
  return Error{ErrorKind::kUsage, "--reference-difference wants a .png file"};
}

Status compare_with_reference(const ReferenceArguments& reference, const std::string& name,
                              const Frame& frame, const Picture& picture, bool with_alpha) {
  const std::string& file = *reference.file;
  Result<Verdict> verdict = reference.wants_picture() ? compare_colors(file, picture, with_alpha)
                                                      : compare_facts(file, frame);
  if (!verdict) return verdict.error();
  if (reference.difference && !verdict->difference.rgba.empty()) {
    const Result<std::string> bytes =
        encode(FileFormat::kPng, frame, verdict->difference, false, *reference.difference);
    if (!bytes) return bytes.error();
    if (Status written = write_output(*reference.difference, *bytes); !written) return written;
  }
  if (verdict->share <= reference.threshold) return Done{};
  return Error{ErrorKind::kInput,
               fmt::format("{}: error: not as in {}: {}", name, file, verdict->words)};
}

}  // namespace whittle
