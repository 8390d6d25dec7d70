#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/evaluate.h"
#include "io/csg_reader.h"
#include "io/csg_text.h"
#include "io/named_files.h"
#include "io/read.h"
#include "model/document.h"

namespace whittle {

Result<Read> read_csg(std::string_view text, const std::string& file_name,
                      const ReadOptions& options) {
  const Result<std::string_view> checked = check_text(text, file_name, options.limits);
  if (!checked) return checked.error();
  Warnings warnings(file_name);
  std::vector<std::string> files;
  Result<Document> document = read_document(*checked, file_name, options, warnings);
  if (!document) return document.error();
  EvaluateOptions evaluating{.curves = options.curves,
                             .most_facets = options.limits.facets,
                             .threads = options.threads,
                             .read_file = nullptr,
                             .outlines = options.outlines,
                             .solid_box = options.solid_box};
  if (options.folder) {
    evaluating.read_file = [&, read = named_files(*options.folder, options.import_root,
                                                  options.limits.bytes)](const std::string& name) {
      std::string path = (std::filesystem::path(*options.folder) / name).string();
      if (std::ranges::find(files, path) == files.end()) files.push_back(std::move(path));
      return read(name);
    };
  }
  StatementCounts counts = std::move(document->counts);
  Result<Model> model = evaluate(std::move(*document), evaluating, warnings);
  if (!model) return model.error();
  const std::optional<Unsupported> unsupported = warnings.unsupported();
  std::string refusal;
  if (unsupported) {
    refusal =
        message_at(file_name, unsupported->where, fmt::format("error: {}", unsupported->message));
  }
  return Read{std::move(*model), std::move(counts),  warnings.take(),
              unsupported,       std::move(refusal), std::move(files)};
}

}  // namespace whittle
