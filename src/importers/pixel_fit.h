// Fits the intrinsics of one image axis to points and their pixels.
#pragma once

#include <algorithm>
#include <cmath>

namespace vitruvia {

// pixel = focal × slope + center by least squares, from sums; slope is x/z of a column's points, or
// y/z of a row's.
class PixelFit {
 public:
  void Add(double slope, double pixel) {
    ++count_;
    slope_ += slope;
    pixel_ += pixel;
    slope_slope_ += slope * slope;
    slope_pixel_ += slope * pixel;
    pixel_pixel_ += pixel * pixel;
  }

  long count() const { return count_; }
  double focal() const { return Covariance() / Variance(); }
  double center() const { return (pixel_ - focal() * slope_) / static_cast<double>(count_); }
  bool is_determined() const { return count_ > 1 && Variance() > 0.0; }
  double SquaredResiduals() const {
    const double spread = pixel_pixel_ - pixel_ * pixel_ / static_cast<double>(count_);
    return std::max(0.0, spread - focal() * Covariance());
  }

 private:
  double Variance() const { return slope_slope_ - slope_ * slope_ / static_cast<double>(count_); }
  double Covariance() const { return slope_pixel_ - slope_ * pixel_ / static_cast<double>(count_); }

  long count_ = 0;
  double slope_ = 0.0, pixel_ = 0.0;
  double slope_slope_ = 0.0, slope_pixel_ = 0.0, pixel_pixel_ = 0.0;
};

}  // namespace vitruvia
