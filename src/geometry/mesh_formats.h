// Readers of the mesh formats, for mesh_io alone. Each takes a file's content and its name for
// messages, and returns vertices (unscaled, in the file's frame) and triangles, both in the file's
// order; everything else that a file may hold (normals, colours, texture coordinates, other
// elements) is skipped. DataError with file, line or byte, and cause if the file is damaged or cut
// short, or if a face is not a triangle. Indices are not compared with the number of vertices.
//
// They are our own because no library at hand does all of it: OpenMesh refuses whole files (a
// second list on faces, a comment before the format, continued lines), VTK crashes on files that
// are cut short and duplicates vertices that have texture coordinates, tinyobjloader (2.0.0rc10)
// silently reads "abc" and "nan" as 0 and "2,5" as 2 and refuses continued lines, and none of them
// reports where a file is damaged.
#pragma once

#include <string>
#include <string_view>

#include "geometry/mesh.h"

namespace vitruvia {

// PLY 1.0, text or binary of either byte order: any types, properties and elements in any order,
// comments anywhere in the header, extra lists. Text holds one element a line.
TriangleMesh ParsePly(std::string_view content, const std::string& file);

// Wavefront OBJ: polygonal statements, relative indices, lines continued with a backslash. A
// comment ends with its line. Statements of the format that add no faces are skipped; others are
// refused.
TriangleMesh ParseObj(std::string_view content, const std::string& file);

// Text OFF, also with colours, normals or texture coordinates (COFF, NOFF, STOFF and mixtures).
TriangleMesh ParseOff(std::string_view content, const std::string& file);

}  // namespace vitruvia
