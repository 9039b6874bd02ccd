/// A mesh as so few triangles that a page can hold them.
#pragma once

#include <Eigen/Geometry>

#include "mesh/triangle_mesh.h"
#include "scene/object_surface.h"

namespace prehensile {

/// The mesh in O, whole where it has no more than `most` triangles. Else the vertices in
/// each cell of a grid are one of them, the one nearest to their mean; the grid is the
/// finest that leaves few enough.
ObjectSurface few_triangles(const TriangleMesh& mesh, const Eigen::Isometry3d& X_OM,
                            int most = 2000);

}  // namespace prehensile
