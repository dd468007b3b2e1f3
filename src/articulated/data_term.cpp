#include "articulated/data_term.h"

#include <cmath>

namespace vitruvia::articulated {

double Narrowed(double first, double last, double progress) {
  return first * std::pow(last / first, progress);
}

}  // namespace vitruvia::articulated
