#include "loading.h"

#include <utility>

#include "../limits.h"
#include "host/input_kinds.h"

namespace whittle {
namespace {

Result<std::unique_ptr<Drawable>> load_drawable(const RenderArguments& arguments,
                                                const Loading& loading, const std::string& file,
                                                LoadStage& stage, const std::stop_token& stop) {
  if (Status possible = check_loading(file, loading); !possible) return possible.error();
  FileOptions options = read_options(loading);
  options.flatten.stop = stop;
  if (kind_of_input(file) == InputKind::kScad) stage.what = "openscad and reading";
  Result<Read> read = with_limit_option(read_file(file, options));
  if (!read) return read.error();
  if (stop.stop_requested()) return Error{ErrorKind::kInput, "stopped"};
  stage.what = "preparing";
  return make_drawable(*std::move(read), arguments.renderer);
}

Result<std::unique_ptr<Drawable>> text_drawable(const RenderArguments& arguments,
                                                const Loading& loading, const std::string& file,
                                                const std::string& text, LoadStage& stage) {
  Result<Read> read = with_limit_option(read_edited_text(file, text, read_options(loading)));
  if (!read) return read.error();
  stage.what = "preparing";
  return make_drawable(*std::move(read), arguments.renderer);
}

}  // namespace

LatestJob<LoadedModel>::Job text_loading_job(const RenderArguments& arguments,
                                             const Loading& loading, const std::string& file,
                                             std::string text,
                                             const std::shared_ptr<LoadStage>& stage) {
  return [&arguments, loading, file, text = std::move(text), stage](const std::stop_token&) {
    const FileWatch::Time began = std::chrono::system_clock::now();
    return LoadedModel{text_drawable(arguments, loading, file, text, *stage), began};
  };
}

LatestJob<LoadedModel>::Job loading_job(const RenderArguments& arguments, const Loading& loading,
                                        const std::string& file,
                                        const std::optional<ViewOptions>& framing,
                                        const std::shared_ptr<LoadStage>& stage) {
  return [&arguments, loading, file, framing, stage](const std::stop_token& stop) {
    const FileWatch::Time began = std::chrono::system_clock::now();
    LoadedModel loaded{load_drawable(arguments, loading, file, *stage, stop), began};
    // Here it is found while the window opens.
    if (framing && loaded.drawable) (*loaded.drawable)->renderer->camera(*framing);
    return loaded;
  };
}

}  // namespace whittle
