// Vectors of space and of the plane.
#pragma once

#include <cmath>

namespace whittle {

template <class T>
struct Vec3T {
  T x{}, y{}, z{};

  constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

  constexpr bool operator==(const Vec3T&) const = default;
  constexpr Vec3T operator-() const { return {-x, -y, -z}; }
  constexpr Vec3T operator+(Vec3T b) const { return {x + b.x, y + b.y, z + b.z}; }
  constexpr Vec3T operator-(Vec3T b) const { return {x - b.x, y - b.y, z - b.z}; }
  constexpr Vec3T operator*(T s) const { return {x * s, y * s, z * s}; }
  constexpr Vec3T operator/(T s) const { return {x / s, y / s, z / s}; }
  constexpr Vec3T& operator+=(Vec3T b) { return *this = *this + b; }
  constexpr Vec3T& operator-=(Vec3T b) { return *this = *this - b; }
  constexpr Vec3T& operator*=(T s) { return *this = *this * s; }
};

using Vec3 = Vec3T<double>;
using Vec3f = Vec3T<float>;

constexpr Vec3 to_double(Vec3f v) {
  return {double(v.x), double(v.y), double(v.z)};
}

template <class T>
constexpr Vec3T<T> operator*(T s, Vec3T<T> v) {
  return v * s;
}
template <class T>
constexpr T dot(Vec3T<T> a, Vec3T<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3T<T> cross(Vec3T<T> a, Vec3T<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(Vec3T<T> a) {
  return std::sqrt(dot(a, a));
}
/// The unit vector along `a`; the zero vector stays zero.
template <class T>
Vec3T<T> normalize(Vec3T<T> a) {
  const T l = length(a);
  return l > T(0) ? a * (T(1) / l) : a;
}
/// Componentwise minimum.
template <class T>
constexpr Vec3T<T> min(Vec3T<T> a, Vec3T<T> b) {
  return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
/// Componentwise maximum.
template <class T>
constexpr Vec3T<T> max(Vec3T<T> a, Vec3T<T> b) {
  return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}
/// Componentwise absolute value.
template <class T>
constexpr Vec3T<T> abs(Vec3T<T> a) {
  return {a.x < 0 ? -a.x : a.x, a.y < 0 ? -a.y : a.y, a.z < 0 ? -a.z : a.z};
}
/// The largest component.
template <class T>
constexpr T max_component(Vec3T<T> a) {
  const T m = a.x < a.y ? a.y : a.x;
  return m < a.z ? a.z : m;
}
/// True if no component is an infinity or NaN.
inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A point or vector of the plane.
struct Vec2 {
  double x = 0, y = 0;

  constexpr bool operator==(const Vec2&) const = default;
  constexpr Vec2 operator-() const { return {-x, -y}; }
  constexpr Vec2 operator+(Vec2 b) const { return {x + b.x, y + b.y}; }
  constexpr Vec2 operator-(Vec2 b) const { return {x - b.x, y - b.y}; }
  constexpr Vec2 operator*(double s) const { return {x * s, y * s}; }
};
constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// Twice the area of the triangle 0, a, b; positive if it runs counter-clockwise.
constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
inline double length(Vec2 a) {
  return std::hypot(a.x, a.y);
}
inline bool is_finite(Vec2 a) {
  return std::isfinite(a.x) && std::isfinite(a.y);
}

}  // namespace whittle
