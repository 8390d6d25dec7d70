// From a file to what the window draws, beside it: the one place where a new model comes from.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "../render_arguments.h"
#include "base/timing.h"
#include "viewer/file_watch.h"
#include "viewer/latest_job.h"
#include "viewer/painter.h"

namespace whittle {

struct LoadedModel {
  Result<std::unique_ptr<Drawable>> drawable;
  FileWatch::Time began;  ///< what is written later has not been read
};

/// How far loading has come; words that live forever.
struct LoadStage {
  std::atomic<const char*> what = "reading";
  Stopwatch watch;
};

/// Reads a file as the command line says, and makes it ready to be drawn: with a framing, so that
/// it is known where the solid is. A stop ends openscad. `arguments` must outlive the job.
LatestJob<LoadedModel>::Job loading_job(const RenderArguments& arguments, const Loading& loading,
                                        const std::string& file,
                                        const std::optional<ViewOptions>& framing,
                                        const std::shared_ptr<LoadStage>& stage);

/// The same of a text that the file may not have yet.
LatestJob<LoadedModel>::Job text_loading_job(const RenderArguments& arguments,
                                             const Loading& loading, const std::string& file,
                                             std::string text,
                                             const std::shared_ptr<LoadStage>& stage);

}  // namespace whittle
