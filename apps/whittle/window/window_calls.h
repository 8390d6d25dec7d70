// GLFW and X11, opened when the first window is.
//
// Nothing of them is loaded by a run without a window: linked, they would cost every start.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XShm.h>
// X11's word for a number.
#undef Status

// Of GLFW's header for X11, which wants more of X11 than it uses.
extern "C" {
Display* glfwGetX11Display(void);
Window glfwGetX11Window(GLFWwindow* window);
}

namespace whittle {

#define WHITTLE_GLFW_CALLS(call)                                                                   \
  call(glfwInit) call(glfwTerminate) call(glfwGetError) call(glfwWindowHint)                       \
      call(glfwWindowHintString) call(glfwCreateWindow) call(glfwDestroyWindow)                    \
          call(glfwSetWindowTitle) call(glfwSetWindowUserPointer) call(glfwGetWindowUserPointer)   \
              call(glfwGetFramebufferSize) call(glfwGetWindowContentScale) call(glfwGetWindowSize) \
                  call(glfwGetPrimaryMonitor) call(glfwGetMonitorContentScale)                     \
                      call(glfwSetWindowSize) call(glfwPollEvents) call(glfwWaitEvents)            \
                          call(glfwWaitEventsTimeout) call(glfwPostEmptyEvent)                     \
                              call(glfwSetClipboardString) call(glfwGetClipboardString)            \
                                  call(glfwGetTime) call(glfwGetKeyName) call(glfwSetKeyCallback)  \
                                      call(glfwSetCharCallback) call(glfwSetCursorPosCallback)     \
                                          call(glfwSetMouseButtonCallback)                         \
                                              call(glfwSetScrollCallback)                          \
                                                  call(glfwSetDropCallback)                        \
                                                      call(glfwSetWindowCloseCallback)             \
                                                          call(glfwSetWindowRefreshCallback)       \
                                                              call(glfwSetFramebufferSizeCallback) \
                                                                  call(glfwGetX11Display)          \
                                                                      call(glfwGetX11Window)

#define WHITTLE_X11_CALLS(call)                                                \
  call(XCreateGC) call(XFreeGC) call(XCreateImage) call(XPutImage) call(XSync) \
      call(XSetErrorHandler) call(XGetWindowAttributes)

#define WHITTLE_XEXT_CALLS(call)                                                   \
  call(XShmQueryExtension) call(XShmCreateImage) call(XShmAttach) call(XShmDetach) \
      call(XShmPutImage)

struct WindowCalls {
#define WHITTLE_DECLARE(name) decltype(&::name) name = nullptr;
  WHITTLE_GLFW_CALLS(WHITTLE_DECLARE)
  WHITTLE_X11_CALLS(WHITTLE_DECLARE)
  WHITTLE_XEXT_CALLS(WHITTLE_DECLARE)
#undef WHITTLE_DECLARE
};

/// Null if one of the libraries is not there.
const WindowCalls* window_calls();

}  // namespace whittle
