// A small reader of JSON (RFC 8259). Numbers keep their text, because the records ask for integers
// without fraction or exponent where they ask for integers; strings keep theirs for the answer.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

// The record breaks the schema, or is no JSON at all.
struct Broken {};

struct Value {
  enum Kind { null, boolean, number, string, list, object } kind = null;
  bool truth = false;
  std::string text;  // of a number as written; of a string unescaped; empty otherwise
  std::string raw;   // of a string as written, with its quotes
  std::vector<Value> items;
  std::vector<std::pair<std::string, Value>> fields;

  const Value* find(const char* name) const {
    for (auto& [key, value] : fields)
      if (key == name) return &value;
    return nullptr;
  }
  // The field; an error when it is absent.
  const Value& at(const char* name) const {
    const Value* value = find(name);
    if (!value) throw Broken{};
    return *value;
  }
  // The field, or nothing when it is absent or null.
  const Value* given(const char* name) const {
    const Value* value = find(name);
    return value && value->kind != null ? value : nullptr;
  }
  // Checks that this is an object without other keys and without a key given twice.
  const Value& only(std::initializer_list<const char*> names) const {
    if (kind != object) throw Broken{};
    for (auto& field : fields) {
      int known = 0, same = 0;
      for (const char* name : names) known += field.first == name;
      for (auto& other : fields) same += field.first == other.first;
      if (known != 1 || same != 1) throw Broken{};
    }
    return *this;
  }
  const std::vector<Value>& as_list() const {
    if (kind != list) throw Broken{};
    return items;
  }
  const std::string& as_string() const {
    if (kind != string) throw Broken{};
    return text;
  }
  bool as_boolean() const {
    if (kind != boolean) throw Broken{};
    return truth;
  }
  double as_double() const {
    if (kind == number) return std::strtod(text.c_str(), nullptr);
    if (as_string() == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf") return HUGE_VAL;
    if (text == "-inf") return -HUGE_VAL;
    throw Broken{};
  }
  std::int64_t as_integer() const {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    if (kind != number) throw Broken{};
    auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) throw Broken{};
    return value;
  }
};

class Reader {
 public:
  explicit Reader(const std::string& line) : at_(line.data()), end_(at_ + line.size()) {}

  // The one value of the line.
  Value document() {
    Value result = value(0);
    if (blank() != end_) throw Broken{};
    return result;
  }

 private:
  const char* at_;
  const char* end_;

  const char* blank() {
    while (at_ != end_ && std::strchr(" \t\r\n", *at_) && *at_) ++at_;
    return at_;
  }
  bool take(char wanted) {
    if (at_ == end_ || *at_ != wanted) return false;
    ++at_;
    return true;
  }
  void word(const char* wanted) {
    for (; *wanted; ++wanted)
      if (!take(*wanted)) throw Broken{};
  }

  Value value(int depth) {
    Value v;
    if (blank() == end_ || depth > 100) throw Broken{};
    if (*at_ == '"') {
      const char* start = at_;
      v.kind = Value::string;
      v.text = quoted();
      v.raw.assign(start, at_);
    } else if (take('{')) {
      v.kind = Value::object;
      while (blank(), !take('}')) {
        if (!v.fields.empty() && !take(',')) throw Broken{};
        blank();
        std::string key = quoted();
        blank();
        word(":");
        v.fields.emplace_back(std::move(key), value(depth + 1));
      }
    } else if (take('[')) {
      v.kind = Value::list;
      while (blank(), !take(']')) {
        if (!v.items.empty() && !take(',')) throw Broken{};
        v.items.push_back(value(depth + 1));
      }
    } else if (*at_ == 't' || *at_ == 'f') {
      v.kind = Value::boolean;
      v.truth = *at_ == 't';
      word(v.truth ? "true" : "false");
    } else if (*at_ == 'n') {
      word("null");
    } else {
      v.kind = Value::number;
      number(v.text);
    }
    return v;
  }

  void digits(std::string& text) {
    std::size_t before = text.size();
    while (at_ != end_ && *at_ >= '0' && *at_ <= '9') text += *at_++;
    if (text.size() == before) throw Broken{};
  }
  void number(std::string& text) {
    if (take('-')) text += '-';
    if (take('0')) text += '0';
    else digits(text);
    if (take('.')) digits(text += '.');
    if (take('e') || take('E')) {
      text += 'e';
      if (take('-')) text += '-';
      else take('+');
      digits(text);
    }
  }

  unsigned hex() {
    unsigned code = 0;
    for (int i = 0; i < 4; ++i) {
      const char* all = "0123456789abcdef0123456789ABCDEF";
      const char* found = at_ == end_ || !*at_ ? nullptr : std::strchr(all, *at_++);
      if (!found) throw Broken{};
      code = code * 16 + unsigned(found - all) % 16;
    }
    return code;
  }
  std::string quoted() {
    std::string text;
    word("\"");
    while (!take('"')) {
      if (at_ == end_ || static_cast<unsigned char>(*at_) < 0x20) throw Broken{};
      if (!take('\\')) {
        text += *at_++;
        continue;
      }
      const char *from = "\"\\/bfnrt", *to = "\"\\/\b\f\n\r\t";
      if (take('u')) {
        unsigned code = hex();
        if (code >= 0xd800 && code < 0xdc00) {
          word("\\u");
          unsigned low = hex();
          if (low < 0xdc00 || low > 0xdfff) throw Broken{};
          code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
        } else if (code >= 0xdc00 && code < 0xe000) {
          throw Broken{};
        }
        utf8(text, code);
      } else {
        const char* found = at_ == end_ || !*at_ ? nullptr : std::strchr(from, *at_++);
        if (!found) throw Broken{};
        text += to[found - from];
      }
    }
    return text;
  }
  static void utf8(std::string& text, unsigned code) {
    int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    const unsigned lead[] = {0, 0xc0, 0xe0, 0xf0};
    text += char(lead[more] | code >> 6 * more);
    while (more--) text += char(0x80 | (code >> 6 * more & 0x3f));
  }
};
