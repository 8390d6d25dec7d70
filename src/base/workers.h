// A bounded group of threads, and the loop that every parallel part of whittle runs on them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace whittle {

class Workers {
 public:
  /// `threads` 0 or less means as many as the machine has. More than it has are allowed.
  explicit Workers(int threads);
  ~Workers();

  /// How many there are.
  size_t count() const;

  /// Does the part first <= i < last of a loop. No two calls have the same `worker`, which is below
  /// count(), at the same time.
  using Body = std::function<void(size_t first, size_t last, size_t worker)>;

  /// Calls `body` for parts of 0 <= i < n that cover all of it, in any order, and returns when all
  /// is done. The parts are of about `grain` or more. What a call throws is thrown here, without
  /// the rest being done. `body` must not start another loop of the same workers.
  void for_parts(size_t n, size_t grain, const Body& body) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same loop, on this thread alone if there are no workers or all is one part.
inline void for_parts(const Workers* workers, size_t n, size_t grain, const Workers::Body& body) {
  if (workers != nullptr && n > grain)
    workers->for_parts(n, grain, body);
  else if (n > 0)
    body(0, n, 0);
}

/// What each worker has for itself, made when it first asks.
template <class T>
class PerWorker {
 public:
  explicit PerWorker(const Workers& workers) : places_(workers.count()) {}

  /// The worker's own; made of `parts` if there is none yet.
  template <class... Parts>
  T& of(size_t worker, const Parts&... parts) {
    std::optional<T>& value = places_[worker].value;
    if (!value) value.emplace(parts...);
    return *value;
  }

  /// Calls `visit` for all that there are. Not while a loop runs.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Place& place : places_)
      if (place.value) visit(*place.value);
  }

 private:
  /// Apart from its neighbours', so that no two workers write to one cache line.
  struct alignas(128) Place {
    std::optional<T> value;
  };
  std::vector<Place> places_;
};

}  // namespace whittle
