"""Loads packed files with Blender (module bpy) and compares what arrives with X.glb.expected.json, which a
test wrote beside X.glb. One line per file; status 1 where anything differs."""

import json
import sys

import bpy

# Blender keeps custom normals in 16 bits per angle.
NORMAL_TOLERANCE = 1e-3


def differs(values, want, tolerance):
    """The first vector that is off by more than the tolerance."""
    width = want["width"]
    if len(values) * width != len(want["values"]):
        return f"has {len(values)} vertices, not {len(want['values']) // width}"
    for vertex, value in enumerate(values):
        wanted = want["values"][vertex * width : (vertex + 1) * width]
        if any(not abs(a - b) <= tolerance for a, b in zip(value, wanted)):
            return f"of vertex {vertex} is {tuple(value)}, not {tuple(wanted)}"
    return None


def corner_normals(mesh):
    """The normal of each vertex as glTF has it (Y up), from the first corner that uses it."""
    found = {}
    for loop, normal in zip(mesh.loops, mesh.corner_normals):
        x, y, z = normal.vector
        found.setdefault(loop.vertex_index, (x, z, -y))
    return [found[v] for v in range(len(mesh.vertices))]


def check(file):
    with open(f"{file}.expected.json", encoding="utf8") as text:
        expected = json.load(text)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    meshes = {o.name: o.data for o in bpy.data.objects if o.type == "MESH"}
    problems, compared = [], 0
    for name, attributes in expected["meshes"].items():
        mesh = meshes.get(name)
        if mesh is None:
            problems.append(f"no object {name}, there are {sorted(meshes)}")
            continue
        for attribute, want in attributes.items():
            if attribute == "NORMAL":
                values, tolerance = corner_normals(mesh), NORMAL_TOLERANCE
            elif attribute.startswith("_"):
                arrived = mesh.attributes.get(attribute)
                if arrived is None or arrived.data_type != "FLOAT_VECTOR" or arrived.domain != "POINT":
                    problems.append(f"{name}: {attribute} is {arrived and arrived.data_type}, not one vector per vertex")
                    continue
                values, tolerance = [v.vector for v in arrived.data], want["tolerance"]
            else:
                continue
            problem = differs(values, want, tolerance)
            if problem:
                problems.append(f"{name}: {attribute} {problem}")
            compared += len(values)
    said = "; ".join(problems) or f"{len(expected['meshes'])} objects as expected, {compared} values per vertex compared"
    print(f"Blender {bpy.app.version_string}: {file.rsplit('/', 1)[-1]}: {said}")
    return not problems


# Every file is looked at, even after one that fails.
sys.exit(0 if all([check(file) for file in sys.argv[1:]]) else 1)
