#include "viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "../console.h"
#include "../inquiry.h"
#include "../output_template.h"
#include "base/timing.h"
#include "viewer/command_words.h"
#include "whittle/reading.h"

namespace whittle {
namespace {

/// How often a clock that is shown is looked at, seconds.
constexpr double kTick = 0.1;

std::string title_of(const std::string& file) {
  return file.substr(file.rfind('/') + 1) + " - whittle";
}

bool names_size(Arguments arguments) {
  return std::ranges::any_of(arguments, [](std::string_view word) {
    return word == "--imgsize" || word.starts_with("--imgsize=");
  });
}

}  // namespace

Viewer::Viewer(const RenderArguments& a, Arguments arguments)
    : arguments_(a),
      words_(kept_words(arguments, a.files)),
      asked_curves_(a.loading.curves),
      loading_(a.loading),
      framing_(a.view) {
  if (names_size(arguments)) asked_size_ = PictureSize{a.view.width, a.view.height};
  state_.files = a.files;
  state_.look = {.shading = a.shading, .antialias = a.antialias, .pass = a.pass};
  state_.look.shading.background = true;
  loading_.standard_input = std::make_shared<std::optional<std::string>>();
}

Viewer::~Viewer() {
  // Whoever wakes the window goes before it.
  file_watch_.reset();
  loader_.reset();
  painter_.reset();
  overlay_.reset();
}

Result<int> Viewer::run() {
  const auto wake = [this] {
    if (const ScreenWindow* const window = woken_) window->wake();
  };
  // Both work while the window opens.
  painter_ = std::make_unique<Painter>(wake);
  loader_ = std::make_unique<LatestJob<LoadedModel>>(wake);
  load(true);
  Result<std::unique_ptr<ScreenWindow>> window =
      ScreenWindow::open(title_of(state_.files[0]), asked_size_);
  if (!window) return window.error();
  window_ = *std::move(window);
  state_.size = window_->size();
  framing_.width = state_.size.width, framing_.height = state_.size.height;
  gestures_.emplace(window_->scale());
  woken_ = window_.get();
  file_watch_ = std::make_unique<FileWatch>([this, wake] {
    was_saved_ = true;
    wake();
  });
  while (!quits_) {
    // What came before the window could be woken.
    take_model();
    take_news();
    load_edited();
    if (needs_drawing_ || overlay_frames_ > 0) draw();
    const std::optional<double> seconds = seconds_to_wait();
    handle(window_->wait(seconds));
    // A line has had its time, or a clock goes on.
    needs_drawing_ = needs_drawing_ || seconds > 0.0;
    if (was_saved_.exchange(false)) follow_files();
  }
  if (arguments_.wants_statistics) say_lines(times_.text());
  return kExitDone;
}

std::optional<double> Viewer::seconds_to_wait() {
  if (needs_drawing_ || overlay_frames_ > 0) return 0;
  std::optional<double> least = notices_.next_change();
  if (least) *least = std::max(*least, 0.001);
  if (loader_->is_busy()) least = std::min(least.value_or(kTick), kTick);
  return least;
}

void Viewer::load(bool is_another_file) {
  const std::string& file = state_.files[state_.file];
  if (is_another_file) {
    editing_.close();
    state_.shows_tree = false;
    state_.view.reset();
    awaited_ = 0;
    if (window_) window_->set_title(title_of(file));
  }
  stage_ = std::make_shared<LoadStage>();
  // The curves that were asked for, not those of the last style.
  loading_.curves = asked_curves_;
  suit_style(state_.look.shading.style, loading_);
  framing_.tight = frames_tightly(state_.look.shading.style);
  const auto framing = is_another_file ? std::optional(framing_) : std::nullopt;
  needs_drawing_ = true;
  if (!is_another_file && editing_.is_open() && editing_.document().is_modified()) {
    editing_.mark_shown();
    loader_->start(
        text_loading_job(arguments_, loading_, file, editing_.document().text(), stage_));
    return;
  }
  loader_->start(loading_job(arguments_, loading_, file, framing, stage_));
}

/// What is shown was saved, here or by another program.
void Viewer::follow_files() {
  if (editing_.is_open() && !editing_.follow_file())
    notices_.tell("the file has changed beside what is edited here; Ctrl+S overwrites it");
  load(false);
}

bool Viewer::may_leave() {
  if (!editing_.is_open() || !editing_.document().is_modified()) return true;
  const uint64_t version = editing_.document().version();
  if (warned_version_ == version) return true;
  warned_version_ = version;
  notices_.tell("what is edited is not saved: Ctrl+S saves it; the same again loses it");
  needs_drawing_ = true;
  return false;
}

void Viewer::take_model() {
  std::optional<LoadedModel> loaded = loader_->take();
  if (!loaded) return;
  needs_drawing_ = true;
  const std::string& file = state_.files[state_.file];
  if (!loaded->drawable) {
    notices_.set_error(loaded->drawable.error().message);
    say(loaded->drawable.error().message);
    // What it names is not known; most likely it is what it was.
    if (std::ranges::find(watched_, file) == watched_.end()) watched_ = {file};
    file_watch_->watch(watched_, loaded->began);
    return;
  }
  std::unique_ptr<Drawable> drawable = *std::move(loaded->drawable);
  watched_ = drawable->read.files;
  file_watch_->watch(watched_, loaded->began);
  const Status fit = say_warnings(drawable->read, loading_);
  notices_.set_error(fit ? "" : fit.error().message);
  if (!fit) {
    say(fit.error().message);
    return;
  }
  if (!loading_.quiet)
    for (const std::string& warning : drawable->read.warnings) notices_.tell(warning);
  has_model_ = true;
  painter_->use(std::move(drawable), request(false));
}

void Viewer::take_news() {
  Painter::News news = painter_->take();
  if (news.failure) {
    notices_.set_error(news.failure->message);
    needs_drawing_ = true;
  }
  if (news.painted) {
    // The size may have changed meanwhile; what is shown then comes soon.
    if (!state_.view && news.painted->number == awaited_) state_.view = news.painted->view;
    painted_ = std::move(news.painted);
    is_new_ = true;
    needs_drawing_ = true;
  }
  for (const PickAnswer& answer : news.answers) {
    --unanswered_;
    needs_drawing_ = true;
    if (unwanted_ > 0) {
      --unwanted_;
      continue;
    }
    PickedPoint picked{.answer = answer, .place = {}, .statement = {}};
    const std::string& file = state_.files[state_.file];
    if (answer.place != SourceLocation{}) {
      picked.place = fmt::format("{}:{}:{}", file, answer.place.line, answer.place.column);
      picked.statement = statement_at(file, answer.place);
    }
    if (answer.id != 0) print(pick_text(picked) + "\n");
    if (editing_.is_open()) editing_.choose(answer.place);
    add_pick(std::move(picked), state_);
  }
  for (const Result<std::string>& saved : news.saved) {
    notices_.tell(saved ? "saved " + *saved : saved.error().message);
    say(saved ? "saved " + *saved : saved.error().message);
    needs_drawing_ = true;
  }
}

PaintRequest Viewer::request(bool is_moving) {
  PaintRequest result;
  result.number = ++number_;
  if (state_.view)
    result.view = rounded(*state_.view);
  else
    awaited_ = number_;
  result.framing = framing_;
  result.size = state_.size;
  result.look = state_.look;
  result.is_moving = is_moving;
  return result;
}

void Viewer::show(bool is_moving) {
  painter_->show(request(is_moving));
}

void Viewer::fit() {
  const ViewOptions framing =
      framing_options(*state_.view, state_.size, frames_tightly(state_.look.shading.style));
  state_.view.reset();
  PaintRequest framed = request(false);
  framed.framing = framing;
  painter_->show(std::move(framed));
}

void Viewer::act_on(Action action) {
  needs_drawing_ = true;
  const bool is_step = action == Action::kNextFile || action == Action::kPreviousFile;
  const bool leaves = action == Action::kQuit || (is_step && state_.files.size() > 1);
  if (leaves && !may_leave()) return;
  const Style style = state_.look.shading.style;
  switch (act(action, state_)) {
    case Effect::kNone:
      return;
    case Effect::kMove:
      return show(true);
    case Effect::kPaint:
      if (style == state_.look.shading.style) return show(false);
      return load_if_curves_changed();
    case Effect::kFit:
      return fit();
    case Effect::kReset:
      state_.view.reset();
      return show(false);
    case Effect::kLoad:
      return load(!state_.view);
    case Effect::kSave:
      return save(!arguments_.no_background);
    case Effect::kSaveWithoutBackground:
      return save(false);
    case Effect::kOpenText:
      return open_text();
    case Effect::kUndo:
      if (editing_.is_open()) editing_.undo();
      return;
    case Effect::kRedo:
      if (editing_.is_open()) editing_.redo();
      return;
    case Effect::kSaveText:
      return save_text();
    case Effect::kCopyCamera:
      return copy_camera();
    case Effect::kCopyCommand:
      return copy_command();
    case Effect::kQuit:
      quits_ = true;
      return;
  }
}

void Viewer::load_if_curves_changed() {
  framing_.tight = frames_tightly(state_.look.shading.style);
  if (curves_in_style(state_.look.shading.style, asked_curves_) == loading_.curves)
    show(false);
  else
    load(false);
}

std::string Viewer::output_name() const {
  return template_name(state_.files[state_.file]) + ".png";
}

/// What is there already stays.
std::string Viewer::new_output_path() {
  std::string path = output_name();
  const std::string stem = path.substr(0, path.rfind('.'));
  std::error_code unknown;
  for (int i = 2; given_paths_.contains(path) || std::filesystem::exists(path, unknown); ++i)
    path = fmt::format("{}-{}.png", stem, i);
  given_paths_.insert(path);
  return path;
}

void Viewer::save(bool with_background) {
  if (!state_.view) return;
  SaveRequest wanted{rounded(*state_.view), state_.size, state_.look, new_output_path()};
  wanted.look.shading.background = with_background;
  painter_->save(std::move(wanted));
}

void Viewer::open_text() {
  const Status opened = editing_.open(state_.files[state_.file], loading_.limits);
  if (opened) return;
  state_.shows_tree = false;
  notices_.tell(opened.error().message);
}

void Viewer::save_text() {
  if (!editing_.is_open()) return;
  const Status saved = editing_.save();
  notices_.tell(saved ? "saved " + editing_.file() : saved.error().message);
}

/// Shows what was edited. One text at a time, so that a drag of a large model is seen too.
void Viewer::load_edited() {
  if (!editing_.is_behind() || loader_->is_busy()) return;
  editing_.mark_shown();
  stage_ = std::make_shared<LoadStage>();
  loader_->start(
      text_loading_job(arguments_, loading_, editing_.file(), editing_.document().text(), stage_));
}

void Viewer::copy_camera() {
  if (!state_.view) return;
  const std::string text = camera_of_command(rounded(*state_.view));
  window_->copy(text);
  notices_.tell("copied: " + text);
  print(text + "\n");
}

void Viewer::copy_command() {
  if (!state_.view) return;
  const std::string text = command_text(words_, state_.files[state_.file], rounded(*state_.view),
                                        state_.size, state_.look, output_name());
  window_->copy(text);
  notices_.tell("copied: " + text);
  print(text + "\n");
}

}  // namespace whittle
