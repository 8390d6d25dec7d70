// Any bytes as a .scad file: the variables that it offers are read twice alike, and what openscad
// is told of them is read as the same variable again.
#include <string>
#include <string_view>
#include <vector>

#include "edit/customizer.h"
#include "fuzz/require.h"
#include "fuzz/target.h"

namespace whittle {
namespace {

void check(std::string_view text) {
  const std::vector<CustomizerVariable> variables = read_customizer(text);
  require(variables.size() == read_customizer(text).size(), "read again there are others");
  std::vector<CustomizerValue> values;
  for (const CustomizerVariable& variable : variables) {
    require(variable.line >= 1, "a variable without a line");
    require(!variable.least || *variable.least <= *variable.most, "a range that is none");
    require(!variable.step || *variable.step > 0, "a step that is none");
    const std::vector<CustomizerVariable> again =
        read_customizer(definition(variable, variable.value) + ";");
    require(again.size() == 1 && again[0].name == variable.name, "a variable is lost");
    require(again[0].value == variable.value, "the value is another");
    values.push_back(variable.value);
  }
  require(definitions(variables, values).empty(), "what is not changed is told");
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  whittle::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
