#include "viewer/command_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "whittle/camera_text.h"

namespace whittle {
namespace {

constexpr std::string_view kWithValue[] = {"--camera", "--imgsize",    "--projection",
                                           "--fov",    "--style",      "--quality",
                                           "--pass",   "--colorscheme"};
constexpr std::string_view kFlags[] = {"--viewall", "--autocenter", "--shadows", "--no-ground"};

/// As a shell has to be told.
std::string quoted(const std::string& word) {
  constexpr std::string_view kHarmless = "%+,-./:=@_";
  const auto is_harmless = [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kHarmless.find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_harmless)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// What differs from what the command line takes without a word.
std::vector<std::string> words_of(const Look& look) {
  const Look usual;
  const ShadeSettings& shading = look.shading;
  std::vector<std::string> words;
  const auto add = [&](const char* option, const std::string& value) {
    words.push_back(fmt::format("--{}={}", option, value));
  };
  if (shading.style != usual.shading.style || look.cells)
    add("style", name_of(style_choices(), shading.style));
  if (shading.quality != usual.shading.quality)
    add("quality", name_of(quality_choices(), shading.quality));
  if (!shading.ground) words.emplace_back("--no-ground");
  if (shading.shadows) words.emplace_back("--shadows");
  if (shading.scheme != nullptr) add("colorscheme", std::string(shading.scheme->name));
  if (look.cells)
    add("show", name_of(cell_view_choices(), *look.cells));
  else if (look.pass != usual.pass)
    add("pass", name_of(pass_choices(), look.pass));
  return words;
}

}  // namespace

std::vector<std::string> kept_words(std::span<const char* const> arguments,
                                    std::span<const std::string> files) {
  std::vector<std::string> kept;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view word = arguments[i];
    const size_t equals = word.find('=');
    if (std::ranges::find(kWithValue, word.substr(0, equals)) != std::end(kWithValue)) {
      if (equals == std::string_view::npos) ++i;
      continue;
    }
    if (std::ranges::find(kFlags, word) != std::end(kFlags)) continue;
    if (std::ranges::find(files, word) != files.end()) continue;
    kept.emplace_back(word);
  }
  return kept;
}

std::string camera_of_command(const OrbitView& view) {
  return camera_text(view_options(view, {}));
}

std::string command_text(std::span<const std::string> kept, const std::string& file,
                         const OrbitView& view, PictureSize size, const Look& look,
                         const std::string& output) {
  std::vector<std::string> words{"whittle"};
  if (look.cells) words.emplace_back("cells");
  words.push_back(file);
  words.insert(words.end(), kept.begin(), kept.end());
  words.push_back("--camera=" + camera_of_command(view));
  words.push_back(fmt::format("--imgsize={},{}", size.width, size.height));
  if (view.orthographic) words.emplace_back("--projection=ortho");
  if (view.fov_degrees != kDefaultFovDegrees)
    words.push_back(fmt::format("--fov={}", view.fov_degrees));
  for (std::string& word : words_of(look)) words.push_back(std::move(word));
  words.emplace_back("-o");
  words.push_back(output);
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

}  // namespace whittle
