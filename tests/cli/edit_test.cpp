// whittle params and edit: what they print and write, and what they refuse.
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace whittle {
namespace {

class Editing : public ProgramTest {
 protected:
  void SetUp() override {
    write("box.scad",
          "// of the box\nwidth = 10; // [5:0.5:50]\nname = \"a\"; // 8\n"
          "/* [Look] */\nfinish = \"M\"; // [M:Matt, shiny]\nlid = true;\n"
          "/* [Hidden] */\nslack = 1;\nmodule box() { cube(width); }\n");
    write("part.csg",
          "// a part\ngroup() {\n\tsphere($fn = 0,  r = 1.50); // keep\n\tcube(size = [1, 2, "
          "3]);\n}\n");
  }
};

TEST_F(Editing, ParamsListsTheVariablesOfAProgram) {
  const Ended listed = run({"params", "box.scad"});
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_EQ(listed.err, "");
  EXPECT_EQ(listed.out,
            "[Parameters]\n"
            "width = 10  [5 to 50, in steps of 0.5]  of the box\n"
            "name = \"a\"  [at most 8 characters]\n"
            "\n"
            "[Look]\n"
            "finish = \"M\"  [\"M\" (Matt), \"shiny\"]\n"
            "lid = true\n");
}

TEST_F(Editing, ParamsAsJson) {
  const auto json = nlohmann::json::parse(run({"params", "box.scad", "--json"}).out);
  const auto& variables = json.at("variables");
  ASSERT_EQ(variables.size(), 4u);
  EXPECT_EQ(variables[0], nlohmann::json::parse(
                              R"({"name": "width", "group": "Parameters", "type": "number",
                                  "description": "of the box", "line": 2, "value": 10.0,
                                  "min": 5.0, "max": 50.0, "step": 0.5})"));
  EXPECT_EQ(variables[1].at("max_length"), 8);
  EXPECT_EQ(variables[2].at("choices"),
            nlohmann::json::parse(
                R"([{"value": "M", "label": "Matt"}, {"value": "shiny", "label": "shiny"}])"));
  EXPECT_EQ(variables[3].at("value"), true);
}

TEST_F(Editing, ParamsOfWhatIsNotThere) {
  const Ended missing = run({"params", "none.scad"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("none.scad"), std::string::npos);
  EXPECT_EQ(run({"params", "part.csg"}).out, "");
}

TEST_F(Editing, EditChangesValuesAndNothingElse) {
  const Ended edited = run({"edit", "part.csg", "--set", "3:2.r=2.5", "--set", "3:2.$fn=30",
                            "--set", "4:2.size[2]=7", "--set", "4:2.center=true"});
  EXPECT_EQ(edited.exit_code, 0);
  EXPECT_EQ(edited.err, "");
  EXPECT_EQ(edited.out,
            "// a part\ngroup() {\n\tsphere($fn = 30,  r = 2.5); // keep\n"
            "\tcube(center = true, size = [1, 2, 7]);\n}\n");
  EXPECT_EQ(run({"edit", "part.csg", "--set", "3:2.r=1", "-o", "part.csg"}).exit_code, 0);
  EXPECT_NE(read("part.csg").find("r = 1);"), std::string::npos);
}

TEST_F(Editing, EditSaysWhatCannotBe) {
  const std::string before = read("part.csg");
  const auto refusal = [&](const std::string& setting, int code) {
    const Ended ended = run({"edit", "part.csg", "--set", setting, "-o", "part.csg"});
    EXPECT_EQ(ended.exit_code, code) << setting;
    return ended.err;
  };
  EXPECT_EQ(refusal("3:1.r=2", 1), "part.csg:3:1: error: no statement begins here\n");
  EXPECT_EQ(refusal("3:2.h=2", 1), "part.csg:3:2: error: sphere has no parameter 'h'\n");
  EXPECT_EQ(refusal("4:2.size[3]=2", 1), "part.csg:4:2: error: 'size' has no element 3\n");
  refusal("3:2=5", 2);
  refusal("3:2.r=1+1", 2);
  refusal("4:2.size[0]=x", 2);
  EXPECT_EQ(run({"edit", "part.csg"}).exit_code, 2);
  EXPECT_EQ(read("part.csg"), before);
}

}  // namespace
}  // namespace whittle
