// Mesh files: PLY, OBJ and OFF, by extension. Metres.
#pragma once

#include <filesystem>

#include "geometry/mesh.h"

namespace vitruvia {

// DataError if the file is missing, damaged, has faces that are not triangles, indices out of
// range, or vertices that are not finite.
TriangleMesh ReadMesh(const std::filesystem::path& file);
void WriteMesh(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace vitruvia
