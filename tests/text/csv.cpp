// SPDX-License-Identifier: MIT
#include "diabolo/text/csv.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

TEST_CASE("Text in a message is quoted, printable and short") {
  CHECK(shown("stick_left") == "\"stick_left\"");
  CHECK(shown(std::string_view("a\0\x93\n", 4)) == "\"a\\x00\\x93\\x0a\"");
  CHECK(shown(std::string(100, 'x')) == "\"" + std::string(40, 'x') + "...\"");
}

TEST_CASE("A shown number reads back as the same double, and no shorter text does") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937_64 generator(seed);
  for (int i = 0; i < 1000; ++i) {
    const double value =
        std::ldexp(std::uniform_real_distribution<double>(-1.0, 1.0)(generator), i % 60 - 30);
    CHECK(std::stod(shown(value)) == value);
  }
  CHECK(shown(0.1) == "0.1");
  CHECK(shown(-0.0) == "-0");
}

TEST_CASE("Well-formed UTF-8 passes, a byte order mark is dropped") {
  CHECK(utf8_text("caf\xc3\xa9 \xe6\x97\xa5 \xf0\x9f\xaa\x80", "f") ==
        "caf\xc3\xa9 \xe6\x97\xa5 \xf0\x9f\xaa\x80");
  CHECK(utf8_text("\xef\xbb\xbfx", "f") == "x");
}

TEST_CASE("Other encodings are named") {
  const auto says = [](std::string_view text) { return complaint([&] { utf8_text(text, "f.csv"); }); };
  CHECK(says("") == "f.csv: the file is empty");
  CHECK(says("\xff\xfe\x61\x62") == "f.csv: the text is UTF-16; expected UTF-8");
  CHECK(says("\xfe\xff\x61\x62") == "f.csv: the text is UTF-16; expected UTF-8");
  CHECK(says(std::string_view("a\nb\0", 4)) ==
        "f.csv, line 2: a zero byte (UTF-16 or not a text); expected text in UTF-8");
  const std::string latin1 =
      "f.csv, line 2: the byte \"\\xe9\" belongs to another encoding; expected text in UTF-8";
  CHECK(says("x\ncaf\xe9\n") == latin1);
  CHECK(says("x\ncaf\xe9") == latin1);
  for (const char* wrong : {"\xc0\x80", "\xc3", "\xc3\x28", "\xe0\x80\x80", "\xed\xa0\x80",
                            "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80", "\x80", "\xe6\x97"})
    CHECK(says(wrong) != "(no complaint)");
}

TEST_CASE("Lines end with LF or CRLF") {
  CsvReader csv("a,\"b,c\",\r\n\nlast\n", "f.csv");
  CHECK(csv.lines_left() == 3);
  CHECK(csv.next_cells() == std::vector<std::string_view>{"a", "b,c", ""});
  CHECK(csv.next_cells() == std::vector<std::string_view>{""});
  CHECK(csv.next_line() == "last");
  CHECK(csv.at_end());
}

TEST_CASE("Line ends of other kinds are refused") {
  CHECK(complaint([] { CsvReader("a\rb\r", "f.csv"); }) ==
        "f.csv: lines end with CR only (old Mac); expected LF or CRLF");
  CHECK(complaint([] { CsvReader("a\nb", "f.csv"); }) ==
        "f.csv: the last line has no line end; the file may be cut off");
  CsvReader cut("1\n2\n3", "f.csv", CutLine::kLeaveOut);
  CHECK(cut.is_cut());
  CHECK(cut.lines_left() == 2);
  CHECK(complaint([] { CsvReader("3", "f.csv", CutLine::kLeaveOut); }) ==
        "f.csv: the last line has no line end; the file may be cut off");
  CHECK(complaint([] { CsvReader("a\rb\n", "f.csv").next_line(); }) ==
        "f.csv, line 1: a CR inside the line; expected LF or CRLF as line end");
  CHECK(complaint([] {
          std::vector<double> row(2);
          CsvReader("1\r,2\n", "f.csv").next_numbers(row);
        }) == "f.csv, line 1: a CR inside the line; expected LF or CRLF as line end");
}

TEST_CASE("Quotes have to close and to fill the cell") {
  CHECK(complaint([] { CsvReader("a,\"b\n", "f.csv").next_cells(); }) ==
        "f.csv, line 1: a quote is not closed");
  CHECK(complaint([] { CsvReader("\"a\"b,c\n", "f.csv").next_cells(); }) ==
        "f.csv, line 1: text follows the quoted cell \"a\"; expected a comma");
}

TEST_CASE("Numbers are read where they are finite, and empty cells are NaN") {
  CsvReader csv("-1.5e-3,,7\r\n , 2 ,-0\n", "f.csv");
  std::vector<double> row(3);
  csv.next_numbers(row);
  CHECK(row[0] == -1.5e-3);
  CHECK(std::isnan(row[1]));
  CHECK(row[2] == 7.0);
  csv.next_numbers(row);
  CHECK(std::isnan(row[0]));
  CHECK(row[1] == 2.0);
  CHECK(std::signbit(row[2]));
}

TEST_CASE("What is not a finite number is refused with its column") {
  for (const char* cell :
       {"nan", "NaN", "inf", "-Infinity", "1e400", "0x10", "1.2.3", "abc", "1 2", "+1", "\"1\"", "--1"}) {
    std::vector<double> row(2);
    const std::string text = std::string("1,") + cell + "\n";
    CHECK(complaint([&] { CsvReader(text, "f.csv").next_numbers(row); }) ==
          "f.csv, line 1: column 2: " + shown(cell) + "; expected a finite number or an empty cell");
  }
  CsvReader named("\"a\",b\n1,NaN\n", "f.csv");
  named.name_columns(named.next_cells());
  std::vector<double> row(2);
  CHECK(complaint([&] { named.next_numbers(row); }) ==
        "f.csv, line 2: column \"b\": \"NaN\"; expected a finite number or an empty cell");
}

TEST_CASE("Ragged rows are counted") {
  std::vector<double> row(3);
  CHECK(complaint([&] { CsvReader("1,2\n", "f.csv").next_numbers(row); }) ==
        "f.csv, line 1: 2 cells; expected 3, as in the header");
  CHECK(complaint([&] { CsvReader("1,2,3,\n", "f.csv").next_numbers(row); }) ==
        "f.csv, line 1: 4 cells; expected 3, as in the header");
  CHECK(complaint([&] { CsvReader("\n", "f.csv").next_numbers(row); }) ==
        "f.csv, line 1: an empty line; expected a row of the table");
}

TEST_CASE("Blank lines at the end do not count, blank lines amid the data do") {
  CsvReader csv("1\n\n2\n\r\n\n", "f.csv");
  csv.drop_blank_end();
  CHECK(csv.lines_left() == 3);
  CsvReader blank("\n\r\n", "f.csv");
  blank.drop_blank_end();
  CHECK(blank.at_end());
}
