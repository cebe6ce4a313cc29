// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/overlaps.hpp"

#include "catch.hpp"
#include "recording/shipped.hpp"

using namespace diabolo;

TEST_CASE("Excerpts that share a few samples are trimmed") {
  const Recording r = test::shipped("swing");
  std::vector<Recording> parts{cut(r, 0, 400), cut(r, 391, 800), cut(r, 790, 1000)};
  const std::vector<std::string> notes = trim_overlaps(parts);
  CHECK(parts[0].size() == 401);
  CHECK(parts[1].size() == 400);
  CHECK(parts[1].time[0] == r.time[401]);
  CHECK(parts[2].time[0] == r.time[801]);
  CHECK(notes ==
        std::vector<std::string>{"'swing' overlaps 'swing' by 10 samples, which are left out of it",
                                 "'swing' overlaps 'swing' by 11 samples, which are left out of it"});
  std::vector<Recording> backwards{cut(r, 391, 800), cut(r, 0, 400)};
  trim_overlaps(backwards);
  CHECK(backwards[0].size() == 410);
  CHECK(backwards[1].time.tail(1)[0] == r.time[390]);
}

TEST_CASE("Takes at the same times, and ones that are given twice, are left alone") {
  const Recording r = test::shipped("swing");
  std::vector<Recording> beside{cut(r, 0, 40), cut(r, 40, 80)};  // that share their border
  CHECK(trim_overlaps(beside).empty());
  CHECK(beside[1].size() == 41);
  std::vector<Recording> others{r, test::shipped("throw"), r, cut(r, 100, 400)};
  CHECK(trim_overlaps(others).empty());
  CHECK(others[2].size() == r.size());
  CHECK(others[3].size() == 301);
}
