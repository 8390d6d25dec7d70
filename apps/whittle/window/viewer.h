// whittle FILE: a window that shows the model.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "../commands.h"
#include "../render_arguments.h"
#include "editing.h"
#include "loading.h"
#include "notices.h"
#include "overlay.h"
#include "panels.h"
#include "viewer/file_watch.h"
#include "viewer/gestures.h"
#include "viewer/viewer_state.h"
#include "window.h"
#include "window_times.h"

namespace whittle {

class Viewer {
 public:
  /// `arguments` are the words of the command line, `a` what they say; both must outlive it.
  Viewer(const RenderArguments& a, Arguments arguments);
  ~Viewer();

  /// Until the window is closed.
  Result<int> run();

 private:
  // What comes in.
  void handle(const std::vector<InputEvent>& events);
  void handle(const InputEvent& event);
  void handle_key(const InputEvent& event);
  void handle_button(const InputEvent& event);
  void handle_resize();
  void take_news();
  void take_model();
  // What is done.
  void act_on(Action action);
  void load(bool is_another_file);
  void load_if_curves_changed();
  /// Whether nothing that is edited would be lost, or it was said that it will be.
  bool may_leave();
  void follow_files();
  void show(bool is_moving);
  void fit();
  void save(bool with_background);
  void open_text();
  void save_text();
  void load_edited();
  void copy_camera();
  void copy_command();
  PaintRequest request(bool is_moving);
  std::string output_name() const;
  std::string new_output_path();
  // What is seen.
  bool needs_overlay();
  PanelContext panels();
  void draw();
  std::optional<double> seconds_to_wait();
  /// The point of the solid that the last picture shows there.
  std::optional<Vec3> point_at(double x, double y) const;

  const RenderArguments& arguments_;
  const std::vector<std::string> words_;  ///< of the command line, kept for others
  std::optional<PictureSize> asked_size_;
  const Curves asked_curves_;
  Loading loading_;  ///< with the curves of the present style
  ViewerState state_;
  Editing editing_;
  std::optional<uint64_t> warned_version_;  ///< of the edited text: that it is not saved was said
  ViewOptions framing_;                     ///< of the first view
  Notices notices_;
  std::optional<Painted> painted_;
  bool is_new_ = false;                ///< that was not yet drawn
  uint64_t number_ = 0, awaited_ = 0;  ///< of the last request, and of the one that says the view
  bool has_model_ = false;
  std::vector<std::string> watched_;
  std::shared_ptr<LoadStage> stage_;
  double mouse_x_ = 0, mouse_y_ = 0;
  std::vector<PickedPoint> picks_before_click_;
  int unanswered_ = 0, unwanted_ = 0;  ///< questions about clicks
  bool needs_drawing_ = true;
  bool shows_overlay_ = false;
  int overlay_frames_ = 0;  ///< ImGui says what a click did one frame later
  bool quits_ = false;
  Stopwatch watch_;
  WindowTimes times_;
  std::set<std::string> given_paths_;  ///< of pictures, also of those that are not written yet
  std::unique_ptr<ScreenWindow> window_;
  std::atomic<const ScreenWindow*> woken_ = nullptr;  ///< that window, when it is open
  std::unique_ptr<Overlay> overlay_;
  std::optional<Gestures> gestures_;
  std::atomic<bool> was_saved_ = false;
  // Threads, which wake the window.
  std::unique_ptr<Painter> painter_;
  std::unique_ptr<LatestJob<LoadedModel>> loader_;
  std::unique_ptr<FileWatch> file_watch_;
};

}  // namespace whittle
