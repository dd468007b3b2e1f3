// Mesh files: PLY, OBJ and OFF, told apart by the extension in any case. Metres.
#pragma once

#include <filesystem>

#include "geometry/mesh.h"

namespace vitruvia {

bool IsMeshFile(const std::filesystem::path& file);  // by its extension

// mesh_formats.h lists what each format may contain. DataError with file, line or byte, and cause
// if the file is missing or damaged, has faces that are not triangles, indices out of range, or
// vertices that are not finite.
TriangleMesh ReadMesh(const std::filesystem::path& file);
// Reads a file whose unit of length is unit_m metres.
TriangleMesh ReadMesh(const std::filesystem::path& file, double unit_m);

// PLY is written as little-endian binary. RunError if the file cannot be written.
void WriteMesh(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace vitruvia
