// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

/// Packets of UR's Real-Time Data Exchange, version 2: a size of two bytes that counts the header too, a type
/// of one, and the payload; all numbers big-endian. (Universal Robots, "RTDE guide".)
namespace stand_in {

/// Bytes that are not the protocol's: the connection that sent them cannot be read on.
struct WireError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class PacketType : std::uint8_t {
  kProtocolVersion = 'V',
  kControllerVersion = 'v',
  kOutputs = 'O',
  kInputs = 'I',
  kStart = 'S',
  kPause = 'P',
  kData = 'U',
  kText = 'M',
};

struct Packet {
  PacketType type;
  std::string payload;
};

/// What a variable of the controller holds. VECTOR6UINT32 is in the protocol but in no variable here.
using Value = std::variant<bool, std::uint8_t, std::uint32_t, std::uint64_t, std::int32_t, double,
                           std::array<double, 3>, std::array<double, 6>, std::array<std::int32_t, 6>>;

inline const char* type_name(const Value& value) {
  constexpr const char* kNames[] = {"BOOL",   "UINT8",    "UINT32",   "UINT64",      "INT32",
                                    "DOUBLE", "VECTOR3D", "VECTOR6D", "VECTOR6INT32"};
  return kNames[value.index()];
}

/// Appends a number.
template <class T>
requires std::is_arithmetic_v<T>
void put(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::little)
    bytes.append(raw.rbegin(), raw.rend());
  else
    bytes.append(raw.begin(), raw.end());
}
template <class T, std::size_t N>
void put(std::string& bytes, const std::array<T, N>& values) {
  for (const T value : values) put(bytes, value);
}
inline void put(std::string& bytes, const Value& value) {
  std::visit([&bytes](const auto& content) { put(bytes, content); }, value);
}

/// Takes a number off the front. Throws WireError where there are not enough bytes.
template <class T>
requires std::is_arithmetic_v<T>
void take(std::string_view& bytes, T& value) {
  if (bytes.size() < sizeof(T))
    throw WireError("a packet ends " + std::to_string(sizeof(T) - bytes.size()) + " bytes early");
  std::array<char, sizeof(T)> raw;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    raw[std::endian::native == std::endian::little ? sizeof(T) - 1 - i : i] = bytes[i];
  if constexpr (std::is_same_v<T, bool>)
    value = raw[0] != 0;
  else
    value = std::bit_cast<T>(raw);
  bytes.remove_prefix(sizeof(T));
}
template <class T, std::size_t N>
void take(std::string_view& bytes, std::array<T, N>& values) {
  for (T& value : values) take(bytes, value);
}
/// Keeps the type that the value has.
inline void take(std::string_view& bytes, Value& value) {
  std::visit([&bytes](auto& content) { take(bytes, content); }, value);
}
template <class T>
T taken(std::string_view& bytes) {
  T value{};
  take(bytes, value);
  return value;
}

/// A packet's bytes.
inline std::string packed(PacketType type, std::string_view payload) {
  std::string bytes;
  put(bytes, static_cast<std::uint16_t>(payload.size() + 3));
  put(bytes, static_cast<std::uint8_t>(type));
  return bytes.append(payload);
}

/// Cuts a stream of bytes into packets.
class PacketReader {
 public:
  void append(std::string_view bytes) { buffer_.append(bytes); }

  /// The next whole packet. Throws WireError where a header is none.
  std::optional<Packet> next() {
    if (buffer_.size() < 3) return {};
    std::string_view head = buffer_;
    const std::size_t size = taken<std::uint16_t>(head);
    if (size < 3)
      throw WireError("a packet says it has " + std::to_string(size) + " bytes; it has 3 or more");
    if (buffer_.size() < size) return {};
    Packet packet{static_cast<PacketType>(taken<std::uint8_t>(head)), buffer_.substr(3, size - 3)};
    buffer_.erase(0, size);
    return packet;
  }

 private:
  std::string buffer_;
};

}  // namespace stand_in
