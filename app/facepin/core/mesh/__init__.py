"""What any mesh has: topology, normals, distances, picking."""
