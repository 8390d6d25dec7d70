// What a program says that was built without its window.
#include "show_window.h"
#include "whittle/export_format.h"

namespace whittle {

Result<int> show_window(const RenderArguments&, Arguments) {
  return Error{ErrorKind::kUsage,
               "this whittle was built without its window; give -o FILE, which may end in " +
                   export_endings()};
}

}  // namespace whittle
