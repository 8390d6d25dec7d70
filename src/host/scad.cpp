#include "host/scad.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "host/child_process.h"
#include "host/dependencies.h"
#include "host/input_file.h"
#include "host/input_kinds.h"
#include "host/openscad_messages.h"
#include "host/openscad_view.h"
#include "host/output_file.h"
#include "host/piped_program.h"
#include "host/private_folder.h"

namespace whittle {
namespace {

Error failure(ErrorKind kind, const std::string& path, const std::string& why) {
  return {kind, fmt::format("{}: error: {}", path, why)};
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// What the user calls openscad.
std::string name_of_openscad(const FlattenOptions& options) {
  if (!options.program.empty()) return options.program;
  const char* const variable = std::getenv("OPENSCAD");
  return variable && *variable != '\0' ? variable : "openscad";
}

Error not_found(const std::string& path, const FlattenOptions& options) {
  const std::string name = name_of_openscad(options);
  if (name == "openscad") {
    return failure(ErrorKind::kMachine, path,
                   "a .scad file is evaluated by openscad, which is not on PATH; install it "
                   "(apt-get install openscad), name another one in $OPENSCAD, or export the "
                   "model as .csg elsewhere");
  }
  const bool is_path = name.find('/') != std::string::npos;
  return failure(
      ErrorKind::kMachine, path,
      fmt::format("there is no program '{}'{} to evaluate it ({})", name, is_path ? "" : " on PATH",
                  options.program.empty() ? "$OPENSCAD names it" : "the options name it"));
}

/// The file's name as openscad is given it: openscad changes its folder to that of the source, so
/// no path may be relative.
Result<std::string> absolute_source(const std::string& path) {
  char* const resolved = ::realpath(path.c_str(), nullptr);
  if (!resolved) return failure(ErrorKind::kInput, path, "cannot be read: " + reason(errno));
  std::string source = resolved;
  std::free(resolved);
  // openscad crashes on the one and says of the other that it can't open it.
  struct stat about {};
  const bool is_folder = ::stat(source.c_str(), &about) == 0 && S_ISDIR(about.st_mode);
  if (is_folder || ::access(source.c_str(), R_OK) != 0) {
    return failure(ErrorKind::kInput, path,
                   "cannot be read: " + reason(is_folder ? EISDIR : errno));
  }
  return source;
}

/// A frame's program comes by standard input and begins with its `$t`: set by -D, which comes last,
/// it would be too late for what the program computes from it. The lines are the program's own.
Status write_frame(const std::string& text, double time, const std::string& path) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  const std::string_view whole = text;
  return write_file(path, fmt::format("$t={};{}", time,
                                      whole.substr(whole.starts_with(kMark) ? kMark.size() : 0)));
}

std::string absolute(const std::string& path) {
  return std::filesystem::absolute(path).string();
}

std::vector<std::string> command_line(const std::string& source, const FlattenOptions& options,
                                      const PrivateFolder& folder) {
  std::vector<std::string> words = {
      "openscad", "-o", folder.csg(), options.time ? "-" : source, "-d", folder.dependencies()};
  // A value that begins with a dash is taken for an option, unless it is joined to its own.
  if (options.renders) words.emplace_back("--render=force");
  for (const std::string& definition : options.definitions) words.push_back("-D" + definition);
  words.push_back("-D" + view_question());
  if (options.parameter_file)
    words.push_back("-p" +
                    (options.time ? absolute(*options.parameter_file) : *options.parameter_file));
  if (options.parameter_set) words.push_back("-P" + *options.parameter_set);
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  return words;
}

/// The files that openscad read, the source first and by the user's name for it.
std::vector<std::string> files_read(const std::string& path, const std::string& source,
                                    const PrivateFolder& folder) {
  std::vector<std::string> files{path};
  const Result<std::string> text = read_text(folder.dependencies());
  if (!text) return files;
  for (std::string& file : read_dependencies(*text)) {
    if (file != source) files.push_back(std::move(file));
  }
  return files;
}

/// What openscad calls its standard input, by the file's name.
void call_by_name(std::string& messages, const std::string& name) {
  constexpr std::string_view kInput = "<stdin>";
  for (size_t at = 0; (at = messages.find(kInput, at)) != std::string::npos; at += name.size()) {
    messages.replace(at, kInput.size(), name);
  }
}

AssignedViews assigned_views(const std::string& source_text, const std::vector<std::string>& files,
                             const FlattenOptions& options) {
  AssignedViews assigned;
  find_assigned_views(source_text, assigned);
  for (const std::string& definition : options.definitions) {
    find_assigned_views(definition, assigned);
  }
  for (const std::string& file : files) {
    // Without the first, which is the source.
    if (&file == &files.front() || kind_of_input(file) != InputKind::kScad) continue;
    if (const Result<std::string> text = read_text(file)) find_assigned_views(*text, assigned);
  }
  return assigned;
}

}  // namespace

std::optional<std::string> find_openscad(const FlattenOptions& options) {
  return find_program(name_of_openscad(options));
}

Result<Flattened> flatten_scad(const std::string& path, const FlattenOptions& options) {
  const std::optional<std::string> program = find_openscad(options);
  if (!program) return not_found(path, options);
  const Result<std::string> source = absolute_source(path);
  if (!source) return source.error();
  const Result<std::string> source_text = read_text(*source);
  if (!source_text) return failure(ErrorKind::kInput, path, "cannot be read");
  if (const std::optional<std::string> foreign = describe_foreign(*source_text)) {
    return failure(ErrorKind::kInput, path, *foreign);
  }
  const std::optional<PrivateFolder> folder = PrivateFolder::create();
  if (!folder) {
    return failure(ErrorKind::kMachine, path, "no temporary folder: " + reason(errno));
  }

  const std::vector<std::string> words = command_line(*source, options, *folder);
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  int error = 0;
  ProgramSurroundings surroundings{.messages = folder->messages(), .stop = options.stop};
  if (options.time) {
    if (Status written = write_frame(*source_text, *options.time, folder->program()); !written) {
      return failure(ErrorKind::kMachine, path, written.error().message);
    }
    surroundings.input = folder->program();
    surroundings.folder = source->substr(0, source->rfind('/') + 1);
  }
  const std::optional<int> status =
      run_program(absolute(*program), arguments.data(), surroundings, error);
  if (!status) {
    return failure(ErrorKind::kMachine, path,
                   fmt::format("{} cannot be run: {}", *program, reason(error)));
  }
  Flattened flattened;
  if (Result<std::string> messages = read_text(folder->messages())) {
    flattened.messages = std::move(*messages);
    if (options.time) call_by_name(flattened.messages, source->substr(source->rfind('/') + 1));
  }
  flattened.files = files_read(path, *source, *folder);
  flattened.view =
      take_view(flattened.messages, assigned_views(*source_text, flattened.files, options));
  if (std::optional<Error> error_said =
          first_error(flattened.messages, path, *source, *source_text)) {
    return *std::move(error_said);
  }
  Result<std::string> text = read_text(folder->csg());
  if (*status != 0 || !text) {
    const std::string said = why_it_ended(flattened.messages);
    return failure(ErrorKind::kInput, path,
                   fmt::format("openscad cannot evaluate it{}{}", said.empty() ? "" : ": ", said));
  }
  flattened.csg = std::move(*text);
  return flattened;
}

}  // namespace whittle
