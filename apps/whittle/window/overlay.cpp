#include "overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/timing.h"
#include "window.h"
#include "window_calls.h"

namespace whittle {
namespace {

constexpr float kLetterHeight = 13;
/// ImGui wants to know how much time went by, and that it is not nothing.
constexpr double kLeastSeconds = 1e-4;

void map_keys(ImGuiIO& io) {
  constexpr std::pair<int, int> kKeys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                           {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                           {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                           {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                           {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                           {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                           {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                           {ImGuiKey_Home, GLFW_KEY_HOME},
                                           {ImGuiKey_End, GLFW_KEY_END},
                                           {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                           {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                           {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                           {ImGuiKey_Space, GLFW_KEY_SPACE},
                                           {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                           {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                           {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                           {ImGuiKey_A, GLFW_KEY_A},
                                           {ImGuiKey_C, GLFW_KEY_C},
                                           {ImGuiKey_V, GLFW_KEY_V},
                                           {ImGuiKey_X, GLFW_KEY_X},
                                           {ImGuiKey_Y, GLFW_KEY_Y},
                                           {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [key, code] : kKeys) io.KeyMap[key] = code;
}

}  // namespace

struct Overlay::State {
  ImGuiContext* context = nullptr;
  std::vector<uint8_t> texels;
  int width = 0, height = 0;  ///< of the texture
  std::string copied;
  // Of each button: pressed since the last frame, and let go after that.
  std::array<bool, IM_ARRAYSIZE(ImGuiIO::MouseDown)> is_fresh{}, is_released{};
  double last_time = 0;
  Stopwatch watch;

  /// What is pressed and let go between two frames is seen as pressed by the next one.
  void press(int button, bool is_down) {
    const auto i = size_t(button);
    is_released[i] = !is_down && is_fresh[i];
    if (is_released[i]) return;
    is_fresh[i] = is_down;
    ImGui::GetIO().MouseDown[button] = is_down;
  }
  void end_frame() {
    for (size_t i = 0; i < is_fresh.size(); ++i) {
      if (is_released[i]) ImGui::GetIO().MouseDown[i] = false;
      is_fresh[i] = is_released[i] = false;
    }
  }
};

Overlay::Overlay(ScreenWindow& window, double scale) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.context = ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ClipboardUserData = &window;
  io.SetClipboardTextFn = [](void* user, const char* text) {
    static_cast<ScreenWindow*>(user)->copy(text);
  };
  io.GetClipboardTextFn = [](void* user) {
    static std::string text;
    text = static_cast<ScreenWindow*>(user)->copied();
    return text.c_str();
  };
  map_keys(io);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.ScaleAllSizes(float(scale));
  style.WindowRounding = 4;
  // Its lines come from the texture, between whose texels nothing is interpolated here.
  style.AntiAliasedLinesUseTex = false;
  ImFontConfig font;
  font.SizePixels = std::round(kLetterHeight * float(scale));
  io.Fonts->Flags |= ImFontAtlasFlags_NoBakedLines | ImFontAtlasFlags_NoMouseCursors;
  io.Fonts->AddFontDefault(&font);
  unsigned char* texels = nullptr;
  io.Fonts->GetTexDataAsAlpha8(&texels, &s.width, &s.height);
  s.texels.assign(texels, texels + size_t(s.width) * size_t(s.height));
}

Overlay::~Overlay() {
  ImGui::DestroyContext(state_->context);
}

void Overlay::feed(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  using Kind = InputEvent::Kind;
  switch (event.kind) {
    case Kind::kKey:
      if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown))
        io.KeysDown[event.code] = event.is_down;
      io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
      io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
      io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
      break;
    case Kind::kCharacter:
      io.AddInputCharacter(event.character);
      break;
    case Kind::kMove:
      io.MousePos = {float(event.x), float(event.y)};
      break;
    case Kind::kButton:
      if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.MouseDown))
        state_->press(event.code, event.is_down);
      break;
    case Kind::kWheel:
      io.MouseWheel += float(event.y);
      io.MouseWheelH += float(event.x);
      break;
    default:
      break;
  }
}

bool Overlay::wants_mouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool Overlay::wants_keyboard() const {
  return ImGui::GetIO().WantTextInput;
}

void Overlay::build(PictureSize size, const std::function<void()>& build) {
  State& s = *state_;
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(size.width), float(size.height)};
  const double now = s.watch.milliseconds() / 1000;
  io.DeltaTime = float(std::max(now - s.last_time, kLeastSeconds));
  s.last_time = now;
  ImGui::NewFrame();
  build();
  ImGui::Render();
  s.end_frame();
}

void Overlay::draw(const Pixels& pixels) const {
  const ImDrawData* const data = ImGui::GetDrawData();
  if (data == nullptr) return;
  const Texture texture{state_->texels.data(), state_->width, state_->height};
  std::vector<Vertex> vertices;
  for (const ImDrawList* const list : std::span(data->CmdLists, size_t(data->CmdListsCount))) {
    vertices.clear();
    for (const ImDrawVert& v : list->VtxBuffer)
      vertices.push_back({v.pos.x, v.pos.y, v.uv.x, v.uv.y, v.col});
    for (const ImDrawCmd& command : list->CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      const ClipRect inside{int(clip.x), int(clip.y), int(clip.z), int(clip.w)};
      draw_triangles(pixels, inside, std::span(vertices).subspan(command.VtxOffset),
                     std::span(list->IdxBuffer.Data + command.IdxOffset, command.ElemCount),
                     texture);
    }
  }
}

}  // namespace whittle
