// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "variables.hpp"

namespace stand_in {

/// Which connection writes which input: one name has one writer at a time.
using InputHolders = std::map<std::string, const void*, std::less<>>;

/// One client's side of RTDE: answers packets, takes what it writes, tells what it asked for.
class RtdeSession {
 public:
  RtdeSession(Variables& outputs, Variables& inputs, InputHolders& holders)
      : outputs_(outputs), inputs_(inputs), holders_(holders) {}
  RtdeSession(const RtdeSession&) = delete;
  RtdeSession& operator=(const RtdeSession&) = delete;
  ~RtdeSession() {
    std::erase_if(holders_, [this](const auto& entry) { return entry.second == this; });
  }

  bool started() const { return started_; }

  /// The answer to a packet, empty where there is none; each question has exactly one. Throws WireError where
  /// the packet is not the protocol's, as when a recipe's size is not what was agreed on.
  std::string answer(const Packet& packet) {
    std::string_view payload = packet.payload;
    std::string reply;
    switch (packet.type) {
      case PacketType::kProtocolVersion:
        put(reply, static_cast<std::uint8_t>(taken<std::uint16_t>(payload) == 2));
        break;
      case PacketType::kControllerVersion:
        for (const std::uint32_t part : {5u, 12u, 4u, 1101661u}) put(reply, part);
        break;
      case PacketType::kOutputs:
        reply = set_up_outputs(payload);
        break;
      case PacketType::kInputs:
        reply = set_up_inputs(payload);
        break;
      case PacketType::kStart:
      case PacketType::kPause:
        started_ = packet.type == PacketType::kStart;
        put(reply, std::uint8_t{1});
        break;
      case PacketType::kData:
        write_inputs(payload);
        return {};
      default:
        throw WireError("a packet of type " + std::to_string(static_cast<int>(packet.type)) +
                        ", which a client does not send");
    }
    return packed(packet.type, reply);
  }

  /// The data packet of this tick, empty where none is due.
  std::string data() {
    if (!started_ || ++ticks_ % divisor_ != 0) return {};
    std::string payload;
    put(payload, std::uint8_t{1});
    for (const Value* value : told_) put(payload, *value);
    return packed(PacketType::kData, payload);
  }

 private:
  static std::vector<std::string_view> names(std::string_view list) {
    std::vector<std::string_view> found;
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      if (comma > 0) found.push_back(list.substr(0, comma));
      list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return found;
  }

  std::string set_up_outputs(std::string_view payload) {
    const double frequency = taken<double>(payload);
    if (!(frequency >= 1 && frequency <= 500))
      throw WireError("outputs at " + std::to_string(frequency) + " Hz; expected 1 to 500");
    divisor_ = std::lround(500 / frequency);
    told_.clear();
    std::string types;
    bool all = true;
    for (const std::string_view name : names(payload)) {
      const Value* value = outputs_.find(name);
      types.append(types.empty() ? "" : ",").append(value ? type_name(*value) : "NOT_FOUND");
      all = all && value;
      told_.push_back(value);
    }
    if (!all) told_.clear();
    std::string reply;
    put(reply, static_cast<std::uint8_t>(all ? 1 : 0));
    return reply + types;
  }

  std::string set_up_inputs(std::string_view payload) {
    std::vector<Value*> recipe;
    std::vector<std::string_view> wanted = names(payload);
    std::string types;
    bool all = true;
    for (const std::string_view name : wanted) {
      Value* value = inputs_.find(name);
      const auto holder = holders_.find(name);
      const bool free = holder == holders_.end() || holder->second == this;
      types.append(types.empty() ? "" : ",")
          .append(!value ? "NOT_FOUND"
                  : free ? type_name(*value)
                         : "IN_USE");
      all = all && value && free;
      recipe.push_back(value);
    }
    std::string reply;
    put(reply, static_cast<std::uint8_t>(all ? recipes_.size() + 1 : 0));
    if (all) {
      for (const std::string_view name : wanted) holders_.insert_or_assign(std::string(name), this);
      recipes_.push_back(std::move(recipe));
    }
    return reply + types;
  }

  void write_inputs(std::string_view payload) {
    const std::size_t recipe = taken<std::uint8_t>(payload);
    if (recipe == 0 || recipe > recipes_.size())
      throw WireError("recipe " + std::to_string(recipe) + " of " + std::to_string(recipes_.size()));
    std::vector<Value> fresh;
    for (const Value* value : recipes_[recipe - 1]) take(payload, fresh.emplace_back(*value));
    if (!payload.empty())
      throw WireError("recipe " + std::to_string(recipe) + ": " + std::to_string(payload.size()) +
                      " bytes too many");
    for (std::size_t i = 0; i < fresh.size(); ++i) *recipes_[recipe - 1][i] = fresh[i];
  }

  Variables& outputs_;
  Variables& inputs_;
  InputHolders& holders_;
  std::vector<const Value*> told_;
  std::vector<std::vector<Value*>> recipes_;
  long divisor_ = 1, ticks_ = 0;
  bool started_ = false;
};

}  // namespace stand_in
