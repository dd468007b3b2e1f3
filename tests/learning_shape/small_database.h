// A database of coarse mannequins, made once.
#pragma once

#include "learning/shape/body_database.h"

namespace vitruvia {

// 40 subjects of 1,594 vertices (one subdivision), the first with 4 pose examples.
const BodyDatabase& SmallDatabase();

}  // namespace vitruvia
