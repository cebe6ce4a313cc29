// SPDX-License-Identifier: MIT
#include "tracks.hpp"

#include "diabolo/recording/check.hpp"

namespace diabolo::python {

namespace {

/// The columns that the rows of `array`, of the shape (size, extent), are; a row with a NaN is a dropout.
template <class AnyTrack, class Matrix>
AnyTrack to_any_track(const Array& array, const std::string& name, py::ssize_t size,
                      Matrix AnyTrack::*numbers) {
  AnyTrack track = AnyTrack::missing(size);
  const py::ssize_t extent = (track.*numbers).rows();
  expect_shape(array, name, {size, extent});
  for (py::ssize_t i = 0; i < size; ++i) {
    const Eigen::Map<const Eigen::VectorXd> row(array.data(i, 0), extent);
    track.valid[i] = !row.array().isNaN().any();
    if (track.valid[i]) (track.*numbers).col(i) = row;
  }
  return track;
}

}  // namespace

Track to_track(const Array& array, const std::string& name, py::ssize_t size) {
  return to_any_track(array, name, size, &Track::position);
}

OrientationTrack to_orientation(const std::optional<Array>& array, const std::string& name,
                                py::ssize_t size) {
  if (!array) return {};
  OrientationTrack track = to_any_track(*array, name, size, &OrientationTrack::quaternion);
  for (py::ssize_t i = 0; i < size; ++i)
    if (track.valid[i] && !normalize_quaternion(track.quaternion.col(i)))
      throw RecordingError(name + ", row " + std::to_string(i) + ": quaternion of norm " +
                           shown(track.quaternion.col(i).norm()) + "; expected 1");
  return track;
}

}  // namespace diabolo::python
