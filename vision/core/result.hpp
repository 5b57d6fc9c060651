// What a boundary (file, device, command line, network) returns: a value, or an error that says
// what went wrong, where, and what to do next. Inside the house invariants are asserted instead.
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <variant>

namespace armsreach {

struct Error {
  enum class Kind {
    input,   // the command or a file is wrong: exit code 2
    device,  // a source, a device or the machine failed: exit code 3
    away,    // a device has gone and is waited for: ask again; exit code 3 where nobody does
  };
  std::string what;    // "depth image is 320x240, the camera says 640x480"
  std::string where;   // "recording/depth/0.033333.png"
  std::string remedy;  // "record again, or give the right camera with --camera"
  Kind kind = Kind::input;

  // One readable line: "where: what (remedy)".
  std::string message() const;
};

struct Nothing {};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}
  // A pointer to a derived class for one to its base, and the like.
  template <std::convertible_to<T> U>
  requires(!std::convertible_to<U, Error>) Result(U&& value)
      : state_(std::in_place_index<0>, std::forward<U>(value)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Asserting access: call only after ok().
  T& value() & { return std::get<0>(state_); }
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }

  const Error& error() const& { return std::get<1>(state_); }
  Error&& error() && { return std::get<1>(std::move(state_)); }

 private:
  std::variant<T, Error> state_;
};

using Status = Result<Nothing>;
inline Status ok() { return Nothing{}; }

}  // namespace armsreach
