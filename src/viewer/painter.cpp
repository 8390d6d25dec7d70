#include "viewer/painter.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/timing.h"
#include "host/input_kinds.h"
#include "image/draw_cells.h"
#include "viewer/enlarge.h"
#include "whittle/output.h"
#include "whittle/reading.h"

namespace whittle {
namespace {

/// How long after the last movement what is still is refined.
constexpr auto kSettled = std::chrono::milliseconds(60);

/// Lights alone.
Look draft_of(Look look) {
  look.shading.quality = Quality::kDraft;
  look.shading.shadows = false;
  look.antialias = 1;
  return look;
}

/// The picture of what the camera sees, as the command line makes it.
Result<Picture> colored(Renderer& renderer, const Frame& frame, const Camera& camera,
                        const Look& look, const std::stop_token& stop) {
  if (look.pass != Pass::kColor) return pass_picture(frame, look.pass, look.shading.background);
  return renderer.shade(frame, camera, look.shading, look.rays(), stop);
}

}  // namespace

Result<std::unique_ptr<Drawable>> make_drawable(Read read, const RendererSettings& settings) {
  auto drawable = std::make_unique<Drawable>();
  drawable->read = std::move(read);
  Result<Renderer> renderer = Renderer::make(drawable->read.model, settings);
  if (!renderer) return renderer.error();
  drawable->renderer.emplace(*std::move(renderer));
  return drawable;
}

std::optional<Vec3> Painted::point_at(double x, double y) const {
  const auto [width, height] = std::pair(picture.width, picture.height);
  if (!(x >= 0 && y >= 0 && x < width && y < height)) return std::nullopt;
  const double coarse_x = (x - width / 2.0) / step.scale + frame.width / 2.0,
               coarse_y = (y - height / 2.0) / step.scale + frame.height / 2.0;
  const Hit& hit = frame.at(int(coarse_x), int(coarse_y));
  if (!hit.hit()) return std::nullopt;
  const Ray ray = camera.ray(coarse_x, coarse_y);
  return ray.origin + ray.direction * double(hit.distance);
}

struct Painter::State {
  std::function<void()> notify;
  mutable std::mutex mutex;
  std::condition_variable changed;
  bool quits = false;
  // What others hand in.
  std::unique_ptr<Drawable> arrived;
  std::optional<PaintRequest> requested;
  std::deque<PickQuestion> questions;
  std::deque<SaveRequest> saves;
  std::stop_source stop;  ///< of what is refined
  // What others take.
  News news;
  // What is the thread's own.
  std::unique_ptr<Drawable> drawable;
  std::vector<SourceLocation> places;  ///< by id; empty until somebody asks
  bool is_prepared = false;
  std::optional<PaintRequest> current;
  bool is_first = false;  ///< of what is current nothing was made yet
  FramePlan plan;
  const Workers workers{0};
  std::jthread thread;

  void run();
  bool has_work() const {
    return quits || arrived || requested || !questions.empty() || !saves.empty();
  }
  /// One piece of work, which unlocks while it lasts; false if there is none.
  bool work(std::unique_lock<std::mutex>& lock);
  void adopt(std::unique_lock<std::mutex>& lock);
  void paint(std::unique_lock<std::mutex>& lock);
  void tell(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    notify();
    lock.lock();
  }
  OrbitView view_of(const PaintRequest& request);
  Status prepare(const Camera& camera);
  /// None if it was stopped.
  Result<std::optional<Painted>> painted(const PaintRequest& request, FrameStep step,
                                         const std::stop_token& token);
  PickAnswer answer(const PickQuestion& question);
  Result<std::string> saved(const SaveRequest& request);
};

OrbitView Painter::State::view_of(const PaintRequest& request) {
  if (request.view) return *request.view;
  GimbalView framed;
  drawable->renderer->camera(request.framing, &framed);
  return rounded(orbit_view(framed, request.framing.orthographic));
}

Status Painter::State::prepare(const Camera& camera) {
  if (is_prepared) return Done{};
  Status prepared = drawable->renderer->prepare(camera);
  is_prepared = bool(prepared);
  return prepared;
}

Result<std::optional<Painted>> Painter::State::painted(const PaintRequest& request, FrameStep step,
                                                       const std::stop_token& token) {
  const Stopwatch watch;
  Renderer& renderer = *drawable->renderer;
  Painted made;
  made.step = step;
  made.view = *request.view;
  made.number = request.number;
  const Camera camera = camera_of(made.view, request.size);
  if (Status prepared = prepare(camera); !prepared) return prepared.error();
  made.camera = step.scale > 1 ? coarse_camera(camera, step.scale) : camera;
  Result<Frame> frame = renderer.trace(made.camera, {.stop = token});
  if (!frame) return frame.error();
  if (token.stop_requested()) return std::optional<Painted>();
  const Look look = step.is_final ? request.look : draft_of(request.look);
  Result<Picture> picture = colored(renderer, *frame, made.camera, look, token);
  if (!picture) return picture.error();
  if (token.stop_requested()) return std::optional<Painted>();
  if (look.cells && renderer.cells() != nullptr)
    draw_cells(*renderer.cells(), renderer.scene()->origin, made.camera, *frame, *look.cells,
               *picture);
  made.picture = step.scale > 1 ? enlarged(*picture, step.scale, request.size.width,
                                           request.size.height, workers)
                                : *std::move(picture);
  made.frame = *std::move(frame);
  made.milliseconds = watch.milliseconds();
  return std::optional<Painted>(std::move(made));
}

PickAnswer Painter::State::answer(const PickQuestion& question) {
  PickAnswer result;
  result.question = question;
  const Camera camera = camera_of(question.view, question.size);
  if (!prepare(camera)) return result;
  const Ray ray = camera.ray(question.x, question.y);
  RayCrossings found;
  if (!drawable->renderer->cast_through({&ray, 1}, found) || found.all.empty()) return result;
  const SurfaceCrossing& first = found.all[0];
  result.id = first.id;
  result.point = ray.origin + ray.direction * first.distance;
  result.normal = first.normal;
  result.distance = first.distance;
  const Model& model = drawable->read.model;
  if (kind_of_input(model.file) != InputKind::kCsg) return result;
  if (places.empty()) places = statement_places(model);
  if (first.id < places.size()) result.place = places[first.id];
  return result;
}

Result<std::string> Painter::State::saved(const SaveRequest& request) {
  const PaintRequest whole{
      .view = request.view, .framing = {}, .size = request.size, .look = request.look};
  Result<std::optional<Painted>> made = painted(whole, {1, true}, {});
  if (!made) return made.error();
  const Result<std::string> bytes = encode(FileFormat::kPng, (*made)->frame, (*made)->picture,
                                           !request.look.shading.background, request.path);
  if (!bytes) return bytes.error();
  if (Status written = write_output(request.path, *bytes); !written) return written.error();
  return request.path;
}

void Painter::State::adopt(std::unique_lock<std::mutex>& lock) {
  std::unique_ptr<Drawable> before = std::exchange(drawable, std::move(arrived));
  places.clear();
  is_prepared = false;
  lock.unlock();
  before.reset();
  lock.lock();
}

void Painter::State::paint(std::unique_lock<std::mutex>& lock) {
  const FrameStep step = *plan.next();
  // What is made in motion is made to its end, or there would never be a picture.
  stop = std::stop_source();
  const std::stop_token token = is_first && !step.is_final ? std::stop_token() : stop.get_token();
  is_first = false;
  PaintRequest& request = *current;
  lock.unlock();
  if (!request.view) request.view = view_of(request);
  Result<std::optional<Painted>> made = painted(request, step, token);
  lock.lock();
  if (made && !*made) return;
  if (made) {
    plan.took((*made)->milliseconds);
    news.painted = std::move(**made);
    news.failure.reset();
  } else {
    current.reset();
    news.failure = made.error();
  }
  tell(lock);
}

bool Painter::State::work(std::unique_lock<std::mutex>& lock) {
  if (arrived) {
    adopt(lock);
    return true;
  }
  if (!drawable) return false;
  if (!questions.empty()) {
    const PickQuestion question = questions.front();
    questions.pop_front();
    lock.unlock();
    const PickAnswer found = answer(question);
    lock.lock();
    news.answers.push_back(found);
    tell(lock);
    return true;
  }
  if (requested) {
    current = std::exchange(requested, std::nullopt);
    plan.restart(int64_t(current->size.width) * current->size.height, current->is_moving);
    is_first = true;
    paint(lock);
    return true;
  }
  if (!saves.empty()) {
    const SaveRequest request = saves.front();
    saves.pop_front();
    lock.unlock();
    Result<std::string> path = saved(request);
    lock.lock();
    news.saved.push_back(std::move(path));
    tell(lock);
    return true;
  }
  if (!current || !plan.next()) return false;
  // Not while it moves: there will be another one at once.
  if (current->is_moving && changed.wait_for(lock, kSettled, [this] { return has_work(); }))
    return true;
  current->is_moving = false;
  paint(lock);
  return true;
}

void Painter::State::run() {
  std::unique_lock lock(mutex);
  while (!quits)
    if (!work(lock)) changed.wait(lock);
  // What was to be saved is.
  for (; drawable && !saves.empty(); saves.pop_front()) static_cast<void>(saved(saves.front()));
}

Painter::Painter(std::function<void()> notify) : state_(std::make_unique<State>()) {
  state_->notify = std::move(notify);
  state_->thread = std::jthread([&s = *state_] { s.run(); });
}

Painter::~Painter() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->quits = true;
    state_->stop.request_stop();
  }
  state_->changed.notify_all();
  state_->thread.join();
}

void Painter::use(std::unique_ptr<Drawable> drawable, PaintRequest request) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->arrived = std::move(drawable);
    state_->requested = std::move(request);
    state_->stop.request_stop();
  }
  state_->changed.notify_all();
}

void Painter::show(PaintRequest request) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->requested = std::move(request);
    state_->stop.request_stop();
  }
  state_->changed.notify_all();
}

void Painter::ask(const PickQuestion& question) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->questions.push_back(question);
    state_->stop.request_stop();
  }
  state_->changed.notify_all();
}

void Painter::save(SaveRequest request) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->saves.push_back(std::move(request));
    state_->stop.request_stop();
  }
  state_->changed.notify_all();
}

Painter::News Painter::take() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->news, News());
}

}  // namespace whittle
