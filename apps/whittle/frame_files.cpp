#include "frame_files.h"

#include <optional>
#include <system_error>
#include <utility>

#include "film/video.h"
#include "host/output_file.h"

namespace whittle {
namespace {

/// A film that is written by whittle itself, to a file or to standard output.
class FilmInFile : public FilmWriter {
 public:
  using Make = std::unique_ptr<FilmWriter> (*)(const FilmSettings&, ByteSink);

  /// No file: standard output.
  FilmInFile(Make make, const FilmSettings& settings, std::optional<OutputFile> file)
      : file_(std::move(file)) {
    writer_ = make(settings, [this](std::string_view bytes) {
      return file_ ? file_->write(bytes) : write_standard_output(bytes);
    });
  }

  Status add(const Picture& picture) override { return writer_->add(picture); }
  Status finish() override {
    if (Status done = writer_->finish(); !done) return done;
    return file_ ? file_->commit() : Status(Done{});
  }

 private:
  std::optional<OutputFile> file_;
  std::unique_ptr<FilmWriter> writer_;  ///< goes first: it may still write
};

Result<std::unique_ptr<FilmWriter>> open_film(const std::string& path, FilmFormat format,
                                              const FilmSettings& settings) {
  if (format == FilmFormat::kMp4 || format == FilmFormat::kWebm) {
    return make_video_writer(
        path, format == FilmFormat::kMp4 ? VideoContainer::kMp4 : VideoContainer::kWebm, settings);
  }
  std::optional<OutputFile> file;
  if (path != "-") {
    Result<OutputFile> created = OutputFile::create(path);
    if (!created) return created.error();
    file.emplace(*std::move(created));
  }
  return std::unique_ptr<FilmWriter>(std::make_unique<FilmInFile>(
      format == FilmFormat::kGif ? make_gif_writer : make_apng_writer, settings, std::move(file)));
}

}  // namespace

Status FrameFiles::open() {
  if (frames_ == 0) return Done{};
  const FilmSettings settings{.width = a_.view.width,
                              .height = a_.view.height,
                              .frames = frames_,
                              .fps = a_.film.fps,
                              .with_alpha = a_.no_background,
                              .threads = a_.renderer.threads};
  for (const Output& output : outputs_) {
    if (!output.is_film()) continue;
    Result<std::unique_ptr<FilmWriter>> film =
        open_film(still_output(a_, output.path), std::get<FilmFormat>(output.format), settings);
    if (!film) return film.error();
    films_.push_back(*std::move(film));
  }
  return Done{};
}

Status FrameFiles::wait() {
  return writing_.valid() ? writing_.get() : Status(Done{});
}

Status FrameFiles::add(int number, Drawn drawn) {
  if (Status before = wait(); !before) return before;
  // What is moved into a thread that cannot be started would be lost.
  const auto kept = std::make_shared<Drawn>(std::move(drawn));
  try {
    writing_ =
        std::async(std::launch::async, [this, number, kept] { return write(number, *kept); });
    return Done{};
  } catch (const std::system_error&) {
    return write(number, *kept);
  }
}

Status FrameFiles::write(int number, const Drawn& drawn) {
  if (Status written = write_pictures(a_, outputs_of_frame(a_, outputs_, number), drawn); !written)
    return written;
  if (films_.empty()) return Done{};
  const Picture picture = shown(a_, drawn.frame, drawn.picture);
  for (const std::unique_ptr<FilmWriter>& film : films_)
    if (Status added = film->add(picture); !added) return added;
  return Done{};
}

Status FrameFiles::finish() {
  if (Status last = wait(); !last) return last;
  for (const std::unique_ptr<FilmWriter>& film : films_)
    if (Status done = film->finish(); !done) return done;
  return Done{};
}

std::vector<Output> outputs_of_frame(const RenderArguments& a, const std::vector<Output>& outputs,
                                     int number) {
  std::vector<Output> of_frame;
  for (const Output& output : outputs)
    if (output.is_picture())
      of_frame.push_back({frame_output(a, output.path, number), output.format});
  return of_frame;
}

}  // namespace whittle
