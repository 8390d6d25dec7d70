#include "film/video.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "base/folder_for_test.h"
#include "film/film_for_test.h"
#include "host/piped_program.h"

namespace whittle {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

TEST(Video, FramesBecomeAFilmOfThatLengthAndSize) {
  ASSERT_TRUE(find_program("ffmpeg") && find_program("ffprobe"));
  const TestFolder folder;
  for (const auto& [name, container] : {std::pair("film.mp4", VideoContainer::kMp4),
                                        std::pair("film.webm", VideoContainer::kWebm)}) {
    const std::string path = folder / name;
    // Odd sides are made even.
    const FilmSettings settings{.width = 63, .height = 40, .frames = 10, .fps = 5};
    Result<std::unique_ptr<FilmWriter>> writer = make_video_writer(path, container, settings);
    ASSERT_TRUE(writer) << writer.error().message;
    for (int i = 0; i < 10; ++i) ASSERT_TRUE((*writer)->add(striped_frame(63, 40, i)));
    EXPECT_FALSE(std::filesystem::exists(path));
    const Status done = (*writer)->finish();
    ASSERT_TRUE(done) << done.error().message;
    const std::string facts = folder / "facts";
    const std::string command =
        "ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames,"
        "r_frame_rate -of csv=p=0 '" +
        path + "' > '" + facts + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::string said(64, '\0');
    std::FILE* const file = std::fopen(facts.c_str(), "r");
    ASSERT_NE(file, nullptr);
    said.resize(std::fread(said.data(), 1, said.size(), file));
    std::fclose(file);
    EXPECT_EQ(said, "64,40,5/1,10\n") << name;
  }
}

TEST(Video, WithoutFfmpegSaysWhatToDo) {
  const TestFolder folder;
  const std::string path = variable("PATH");
  ASSERT_EQ(::setenv("PATH", "/nowhere", 1), 0);
  const Result<std::unique_ptr<FilmWriter>> writer = make_video_writer(
      folder / "x.mp4", VideoContainer::kMp4, {.width = 8, .height = 8, .frames = 1});
  ASSERT_EQ(::setenv("PATH", path.c_str(), 1), 0);
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().kind, ErrorKind::kMachine);
  EXPECT_NE(writer.error().message.find("ffmpeg, which is not on PATH; install it"),
            std::string::npos);
}

}  // namespace
}  // namespace whittle
