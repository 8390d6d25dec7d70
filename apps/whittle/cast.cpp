// whittle cast FILE X,Y,Z DX,DY,DZ: what rays meet, as many as one likes.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "commands.h"
#include "console.h"
#include "inquiry.h"
#include "ray_lines.h"
#include "whittle/output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle cast",
    "Casts rays through a model and says all points where each enters or leaves it.",
    "FILE [X,Y,Z DX,DY,DZ ...] [options]",
    "Without rays they are read from standard input, a line each: x,y,z dx,dy,dz. The\n"
    "length of the direction does not count.\n\n"
    "Examples:\n"
    "  whittle cast part.csg -100,0,5 1,0,0\n"
    "  whittle cast part.csg --first --json < rays.txt\n\n"
    "Exit codes: 0 done, 1 bad input, or something in it is not shown (--lenient: 0),\n"
    "2 bad usage, 3 refused by the machine."};

/// Rays a task.
constexpr size_t kRaysEach = 64;
/// Rays that are answered before more are cast. Their crossings, and what is written of them, take
/// memory, and one ray may have thousands.
constexpr size_t kRaysAtOnce = 2048;

using Text = std::back_insert_iterator<std::string>;

/// Minus zero is written without its sign.
double plain(double number) {
  return number == 0 ? 0 : number;
}

void write_text(Text to, size_t ray, const Ray& way, const SurfaceCrossing& c) {
  const Vec3 p = way.origin + way.direction * c.distance;
  fmt::format_to(to, "{} {} {:.9g} at {:.9g},{:.9g},{:.9g} normal {:.9g},{:.9g},{:.9g} id {}\n",
                 ray, c.enters ? "enters" : "leaves", plain(c.distance), plain(p.x), plain(p.y),
                 plain(p.z), plain(c.normal.x), plain(c.normal.y), plain(c.normal.z), c.id);
}

void write_json(Text to, const Ray& way, const SurfaceCrossing& c) {
  const Vec3 p = way.origin + way.direction * c.distance;
  fmt::format_to(to,
                 "{{\"enters\":{},\"distance\":{},\"point\":[{},{},{}],\"normal\":[{},{},{}],"
                 "\"id\":{}}}",
                 c.enters, plain(c.distance), plain(p.x), plain(p.y), plain(p.z), plain(c.normal.x),
                 plain(c.normal.y), plain(c.normal.z), c.id);
}

/// Rays, counted from 1, and what they cross.
class Caster {
 public:
  Caster(Inquiry& inquiry, const Workers& workers, bool first_only, bool wants_json)
      : inquiry_(inquiry), workers_(workers), first_only_(first_only), wants_json_(wants_json) {}

  Status operator()(std::span<const Ray> rays) {
    for (; !rays.empty(); rays = rays.subspan(std::min(rays.size(), kRaysAtOnce)))
      if (Status done = answer(rays.first(std::min(rays.size(), kRaysAtOnce))); !done) return done;
    return Done{};
  }

 private:
  Status answer(std::span<const Ray> rays) {
    if (Status cast = first_only_ ? cast_first(rays) : inquiry_.cast_through(rays, found_); !cast)
      return cast;
    std::vector<std::string> texts(rays.size() / kRaysEach + 1);
    workers_.for_parts(texts.size(), 1, [&](size_t first, size_t last, size_t) {
      for (size_t part = first; part < last; ++part) {
        const size_t end = std::min((part + 1) * kRaysEach, rays.size());
        for (size_t i = part * kRaysEach; i < end; ++i) write(i, rays[i], texts[part]);
      }
    });
    count_ += rays.size();
    for (const std::string& text : texts)
      if (Status written = write_standard_output(text); !written) return written;
    return Done{};
  }

  Status cast_first(std::span<const Ray> rays) {
    hits_.resize(rays.size());
    if (Status cast = inquiry_.cast(rays, hits_); !cast) return cast;
    found_ = {};
    for (size_t i = 0; i < rays.size(); ++i) {
      const Hit& hit = hits_[i];
      if (hit.hit()) {
        const Vec3 n = to_double(hit.normal);
        found_.all.push_back({double(hit.distance), hit.id, dot(n, rays[i].direction) < 0, n});
      }
      found_.ends.push_back(found_.all.size());
    }
    return Done{};
  }

  void write(size_t i, const Ray& ray, std::string& text) const {
    const Text to = std::back_inserter(text);
    const std::span<const SurfaceCrossing> crossings = found_.of(i);
    const size_t number = count_ + i + 1;
    if (!wants_json_) {
      for (const SurfaceCrossing& crossing : crossings) write_text(to, number, ray, crossing);
      if (crossings.empty()) fmt::format_to(to, "{} nothing\n", number);
      return;
    }
    fmt::format_to(to, "{{\"ray\":{},\"crossings\":[", number);
    for (const SurfaceCrossing& crossing : crossings) {
      if (&crossing != &crossings.front()) text += ',';
      write_json(to, ray, crossing);
    }
    text += "]}\n";
  }

  Inquiry& inquiry_;
  const Workers& workers_;
  const bool first_only_, wants_json_;
  size_t count_ = 0;  ///< rays before these
  std::vector<Hit> hits_;
  RayCrossings found_;
};

}  // namespace

int cast_command(Arguments arguments) {
  CommandLine line(kHelp);
  InquiryArguments a;
  std::vector<std::string> words;
  bool first_only = false;
  line.add_required("FILE", a.file);
  line.add_words("RAY", words);
  OptionGroup(line.app(), "What is asked")
      .add_flag("--first", first_only, "only the first point of each ray, in floats: faster");
  add_inquiry_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  if (words.size() % 2 != 0) {
    return report(
        {ErrorKind::kUsage,
         fmt::format("a ray is two words, X,Y,Z and DX,DY,DZ; '{}' is alone", words.back())});
  }
  std::vector<Ray> rays;
  for (size_t i = 0; i < words.size(); i += 2) {
    const Result<Ray> ray = parse_ray(words[i] + " " + words[i + 1]);
    if (!ray) {
      return report({ErrorKind::kUsage,
                     fmt::format("'{} {}': {}", words[i], words[i + 1], ray.error().message)});
    }
    rays.push_back(*ray);
  }
  if (words.empty() && a.file == "-") {
    return report({ErrorKind::kUsage, "the model and the rays cannot both be standard input"});
  }

  const Result<std::unique_ptr<Inquiry>> opened = Inquiry::open(a);
  if (!opened) return report(opened.error());
  const Workers workers(a.renderer.threads);
  Caster cast(**opened, workers, first_only, a.wants_json);
  const Status done =
      words.empty() ? for_ray_lines(STDIN_FILENO, workers, std::ref(cast)) : cast(rays);
  return done ? (*opened)->code() : report(done.error());
}

}  // namespace whittle
