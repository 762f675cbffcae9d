-- Everything a deck may write, as data: what checks a deck (check.lua), what offers its words (vocabulary.lua) and what
-- prints its reference (reference.lua) all read this one file.
--
-- An entry is a constructor or a method: `path` is what the deck writes, `makes` the kind of object it answers,
-- `arguments` its named arguments in the order of the reference, `later` words of the language that are not built yet,
-- `tightens` whether a load can shorten the interface.
--
-- An argument: { name, type, unit, range = { smallest, largest }, default, required, doc, ... }; `usual` = { smallest, largest,
-- text } warns beyond it. The types:
-- `with`: another argument that must be given too.
--   number, integer       `or_word`: a word allowed instead; `or_function`: a function of x, y, z; `or_table`: a table of named numbers allowed instead
--   boolean, choice       `choices`
--   choices               a list of `choices`
--   name                  text that may become a file name
--   file                  a path, relative to the deck's folder
--   vector, counts        three numbers, three whole numbers
--   numbers               a list of numbers, `at_least`, `at_most`; `or_single`: one alone needs no list
--   settings              a table of numbers by name
--   specification         a file, or a list of { frequency, level }
--   pairs                 a list of pairs of numbers that rise, named by `of`
--   table                 a table of the named `fields`
--   tables                a list of tables of the named `fields`
--   compliance            the same, of rough faces
--   orientation           two axes, a function of a place, or a table of the named `fields`
--   value                 a number, a history or a function of time
--   distributions         a table of distributions, lists of numbers or { distribution, each = list } by name
--   between               two sides, each one of the `kinds`; `or_word`: a word allowed instead
--   except                a list of parts, pairs of parts and interfaces
--   directions            some of the axes, as "xyz", or vectors by name
--   frame                 a frame: `in_frame` says of the other arguments what it turns them as
-- `by_direction`: also a table by the names of directions; `or_names` (of objects): names of parts and patterns for them.
--   object, objects       one of, or a list of, the `kinds`: a kind ("face") or a constructor ("interface.plastic");
--                         of objects `at_least`, `exactly`; `or_single`: one alone needs no list; lists in the list count as their items

local native = ...

local function name_of(what)
  return { "name", type = "name", required = true, doc = "name of the " .. what .. ", for messages and files" }
end

local function frame(doc) return { "frame", type = "frame", default_doc = "the axes of the deck", doc = doc } end

local function between(word)
  return { "between", type = "between", kinds = { "face", "substructure" }, exactly = 2, or_word = word, required = true,
           doc = "the two faces, or parts, of which the faces that touch are found; the first is side 1, on which resultants are counted"
             .. (word and (". \"%s\": a list of interfaces, `first/second`, one for each two parts that touch where they have no interface yet; the same between names of parts "
               .. "(* stands for any text) or lists, { \"board*\", { \"standoff*\", lid } }: one of each side"):format(word) or "") }
end

local all_touching = "all touching"

-- What may be said of all interfaces of an assembly at once.
local function of_all()
  return { "of", type = "objects", kinds = { "substructure" }, at_least = 1, or_names = true, default_doc = "all declared before",
           doc = ("with \"%s\": the parts of the assembly, or names of them (* stands for any text)"):format(all_touching) },
    { "except", type = "except", kinds = { "substructure", "interface" }, default_doc = "none",
      doc = ("with \"%s\", names or lists: parts, pairs of parts { a, b } (or their names) and interfaces whose pairs of parts are left alone"):format(all_touching) }
end
local of_parts, except = of_all()
local function name_unless_all()
  return { "name", type = "name", required = true, required_unless = { "between", all_touching },
           doc = ("name of the interface, for messages; with \"%s\", names or lists before those of the parts"):format(all_touching) }
end

-- What may be said where the meshes of two faces do not match.
local function within()
  return { "within", type = "number", unit = "m", range = { 0, 0.1 }, default_doc = "a ten thousandth of the assembly's diagonal; where faces are found, a hundredth of the facets",
           doc = "how far apart touching faces may be, beyond the facet error of round ones" }
end

local function points()
  return { "points", type = "choice", choices = { "first", "second" }, default_doc = "the face within the other, else the one with fewer points (bushing, viscous: more)",
           doc = "which face has the interface's points at its nodes, where the two meshes do not match" }
end

local function on(kinds, doc)
  return { "on", type = "objects", kinds = kinds, at_least = 1, or_single = true, required = true, doc = doc }
end

local function component(axis, what, unit, range, usual)
  return { axis, in_frame = "component", type = "value", unit = unit, range = range, usual = usual, doc = what .. " along " .. axis }
end

local function components(what, unit, range, usual)
  return component("x", what, unit, range, usual), component("y", what, unit, range, usual), component("z", what, unit, range, usual)
end

-- Of what is held or driven: the axes of the frame must span axes of the deck.
local function motion_in_frame(...)
  local x, y, z = components(...)
  x.in_frame, y.in_frame, z.in_frame = "motion", "motion", "motion"
  return x, y, z, frame "along whose axes x, y and z are: all three, or those of a plane of the deck"
end

local function components_in_frame(...)
  local x, y, z = components(...)
  return x, y, z, frame "along whose axes x, y and z are"
end

-- A bolted joint for the hand formula of VDI 2230.
local bolt_length = { 1e-4, 10 }
local by_hand = {
  "hand", type = "table", doc = "the whole bolt and the clamped parts, for a comparison with VDI 2230's hand formula",
  fields = {
    { "diameter", type = "number", unit = "m", range = { 1e-4, 0.5 }, required = true, doc = "nominal, and of the shank" },
    { "grip", type = "number", unit = "m", range = bolt_length, required = true, doc = "length clamped, from head to nut" },
    { "head", type = "number", unit = "m", range = bolt_length, required = true, doc = "outer diameter of the bearing under the head" },
    { "hole", type = "number", unit = "m", range = bolt_length, required = true, doc = "diameter of the hole" },
    { "outer", type = "number", unit = "m", range = bolt_length, required = true, doc = "diameter of the clamped parts" },
    { "young", type = "number", unit = "Pa", range = { 1e6, 2e12 }, required = true, doc = "of the bolt" },
    { "plate_young", type = "number", unit = "Pa", range = { 1e6, 2e12 }, required = true, doc = "of the clamped parts" },
    { "core", type = "number", unit = "m", range = { 1e-4, 0.5 }, default_doc = "diameter", doc = "diameter of the thread's core" },
    { "thread", type = "number", unit = "m", range = { 0, 10 }, default = 0, doc = "length of the grip that is thread" },
    { "tapped", type = "boolean", default = false, doc = "screwed into the last part, without a nut" },
  },
}
-- The six springs of a bushing and their dampers, in the order of the arguments.
local function with_springs(arguments, last)
  local kinds = { { "", "N/m", "N s/m", "along " }, { "about_", "N m", "N m s", "of the mean rotation about " } }
  for _, is_damper in ipairs { false, true } do
    for _, kind in ipairs(kinds) do
      for _, axis in ipairs { "x", "y", "z" } do
        local key, unit, what = kind[1] .. axis, kind[2], "stiffness " .. kind[4] .. axis .. (kind[1] ~= "" and ", for a radian" or "")
        if is_damper then key, unit, what = key .. "_damping", kind[3], "damper beside it" end
        table.insert(arguments, { key, in_frame = "own_axes", type = "number", unit = unit, range = { 0, is_damper and 1e12 or 1e15 }, default = 0, default_doc = "none", doc = what })
      end
    end
  end
  table.insert(arguments, last)
  return arguments
end

local function share_of_bolt(of)
  return { "share", type = "number", range = { 1e-6, 1 }, default_doc = "1", doc = "modelled fraction: 0.25 of " .. of .. " in a quarter model" }
end

-- What the margins of a bolt are against.
local function rating_of_bolt()
  return { "size", type = "choice", choices = { "M3", "M4", "M5", "M6", "M8", "M10", "M12", "M14", "M16", "M18", "M20", "M22", "M24", "M27", "M30" },
      doc = "thread of the bolt, coarse (ISO 262), for its margins: with `class` its proof load, pi/4 (d - 0.9382 pitch)^2 times the stress of the class" },
    { "class", type = "choice",
      choices = { "4.6", "4.8", "5.6", "5.8", "6.8", "8.8", "9.8", "10.9", "12.9", "A2-50", "A2-70", "A2-80", "A4-50", "A4-70", "A4-80" },
      doc = "its property class: proof stress 225, 310, 280, 380, 440, 580 (above M16: 600), 650, 830, 970 MPa (ISO 898-1); stress at 0.2 % 210, 450, 600 MPa (ISO 3506-1)" },
    { "proof_load", type = "number", unit = "N", range = { 1, 1e9 }, doc = "of the whole bolt, in place of both" },
    { "safety", type = "number", range = { 1, 100 }, default_doc = "1", doc = "factor on what loads and motion add to the preload and take from it" },
    { "joint", type = "objects", kinds = { "interface" }, at_least = 1, or_single = true,
      doc = "contacts that the bolts of `on` clamp, for margins against slip and separation: each bolt has the points that are nearest to its axis" }
end

local friction = { "friction", type = "number", range = { 0, 1000 }, usual = { 0, 2, "metals have 0.05 to 1" }, default = 0, doc = "Coulomb's coefficient" }
local friction_of_contact = { "friction", type = "number", range = friction.range, usual = friction.usual, default_doc = "0, with a warning if bolts are tightened", doc = friction.doc }
local duration = { 1e-9, 100 }  -- s
local any_value = { -1e15, 1e15 }
local usual_gap = { -0.0005, 0.002, "between faces whose meshes coincide gaps are tenths of a millimetre" }
local usual_velocity = { -1000, 1000, "is it in m/s?" }
local usual_acceleration = { -980665, 980665, "beyond 100000 g; is it in m/s^2 already?" }

local words = {}

words[1] = {
  name = "mesh", doc = "Bodies as cells with named groups of facets.",
  {
    "box", makes = "mesh", doc = "A regular box of hexahedra; its faces are xmin, xmax, ymin, ymax, zmin, zmax.",
    arguments = {
      { "size", type = "vector", unit = "m", range = { 1e-7, 100 }, required = true, doc = "lengths along x, y, z" },
      { "cells", type = "counts", range = { 1, 100000 }, required = true, doc = "number of cells along x, y, z" },
      { "origin", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 },
        doc = "the corner of smallest x, y, z" },
      { "order", type = "integer", range = { 1, 2 }, default = 1, doc = "order of the shape functions: 1 makes hex8, 2 hex20" },
      { "cell", type = "choice", choices = { "hex8", "prism6", "tet4", "hex20", "hex27", "prism15", "prism18", "tet10" },
        default_doc = "by `order`", doc = "type of the cells: two prisms or six tetrahedra fill a hexahedron" },
    },
  },
  {
    "gmsh", makes = "mesh file",
    doc = "The volumes of a .geo, .msh, .step or .brep file, read or meshed by gmsh; `file:volume \"name\"` is one of them.",
    arguments = {
      { "file", type = "file", required = true, doc = "path, relative to the deck's folder" },
      { "size", type = "number", unit = "m", range = { 1e-7, 100 }, doc = "size of the elements, if the file sets none" },
      { "set", type = "settings", doc = "parameters of the .geo (DefineConstant) given other values" },
      { "unit", type = "number", unit = "m", range = { 1e-9, 1000 }, default = 1,
        doc = "length of one unit of the file: `unit = mm` for a file in millimetres" },
      { "order", type = "integer", range = { 1, 2 }, default = 1,
        doc = "order of the shape functions; cells of order 2 follow round surfaces" },
      { "cell", type = "choice", choices = { "hex20", "hex27" }, default_doc = "hex20",
        doc = "with `order = 2`: hexahedra (and prisms) with nodes on the edges, or also in the middle of facets and cell; "
          .. "tetrahedra are tet10 either way" },
    },
  },
}

words[1][3] = {
  "step", makes = "assembly",
  doc = "A CAD assembly, .step or .brep: every solid becomes its own mesh, with the names of the file; `assembly:part \"name\"` is one of them.",
  arguments = {
    { "file", type = "file", required = true, doc = "path, relative to the deck's folder" },
    { "order", type = "integer", range = { 1, 2 }, default = 2, doc = "order of the shape functions: 2 makes tet10, 1 tet4" },
    { "parts", type = "texts", or_single = true, default_doc = "all", doc = "names of the parts to mesh, * stands for any text" },
    { "cells", type = "choice", choices = { "tetrahedra", "hexahedra", "hexahedra where possible" }, default = "tetrahedra",
      doc = "hexahedra (hex8 or hex20, with prisms if needed) require extruded solids, such as plates and washers: an error for any other, unless where possible" },
    { "size", type = "number", unit = "m", range = { 1e-7, 100 }, default_doc = "a twentieth of each part's diagonal", doc = "size of the cells" },
    { "sizes", type = "settings", unit = "m", range = { 1e-7, 100 },
      doc = "by the names of parts, as `{ [\"M8 bolt\"] = 2*mm, contacts = 1*mm }`: * stands for any text, `contacts` for faces that touch another part" },
    { "fine", type = "number", unit = "m", range = { 1e-7, 100 },
      doc = "size at the edges of faces that touch another part, growing by 0.35 a length, or { size = (m), growth = 0.35 }",
      or_table = {
        { "at", type = "choice", choices = { "edges" }, default = "edges", doc = "of the faces that touch" },
        { "size", type = "number", unit = "m", range = { 1e-7, 100 }, required = true, doc = "size there" },
        { "growth", type = "number", range = { 0.01, 2 }, default = 0.35, doc = "by which it grows with the distance" },
      } },
    { "round", type = "integer", range = { 4, 400 }, default = 16, doc = "least number of cells around a full circle, as in a hole, if `size` alone gives fewer" },
    { "unit", type = "number", unit = "m", range = { 1e-9, 1000 }, default_doc = "0.001", doc = "length of one unit of a .brep; a .step states its own, which must agree" },
  },
}

local function model_file_arguments(skipped, others)
  return {
    { "file", type = "file", required = true, doc = "path, relative to the deck's folder" },
    { "unit", type = "number", unit = "m", range = { 1e-9, 1000 }, default_doc = "1, or the length of `units`", doc = "length of one unit of the file: `unit = mm`" },
    { "units", type = "text", doc = "consistent units of the file, which its materials need: length, mass or force, time, as \"mm t s\" (N, MPa), \"m kg s\", \"mm kg ms\", \"in lbf s\"" },
    { "skip", type = "texts", or_single = true, default_doc = "none", doc = ("types of elements that are left out, such as { \"%s\" }; %s and other elements between points always are"):format(skipped, others) },
  }
end

words[1][4] = {
  "abaqus", makes = "model file",
  doc = "An .inp of Abaqus, CalculiX, PrePoMax, HyperMesh or FreeCAD, read by this program: parts, faces, regions and materials by the names of the file; "
    .. "`file:part \"name\"` is one of its parts, `file:report()` what it has not used.",
  arguments = model_file_arguments("S4R", "springs, masses"),
}

words[1][5] = {
  "nastran", makes = "model file",
  doc = "A .bdf, .nas, .dat or .fem of Nastran, read by this program: parts by PSOLID, regions by SET, names from the comments of HyperMesh, Femap, Patran, ANSA and Simcenter; "
    .. "`file:part \"name\"` is one of its parts, `file:report()` what it has not used.",
  arguments = model_file_arguments("CQUAD4", "CONM2, RBE2, RBE3, CBUSH"),
}

words[1][6] = {
  "unv", makes = "model file",
  doc = "A universal file (.unv) of Salome, NX, I-DEAS or gmsh, read by this program: parts by groups of solid elements (else by property), faces by groups of elements of surfaces, "
    .. "regions by groups of nodes; `file:part \"name\"` is one of its parts, `file:report()` what it has not used.",
  arguments = {
    { "file", type = "file", required = true, doc = "path, relative to the deck's folder" },
    { "unit", type = "number", unit = "m", range = { 1e-9, 1000 }, default_doc = "as dataset 164 says, else 1", doc = "length of one unit of the file: `unit = mm` where dataset 164 is wrong, as Salome's is" },
    { "skip", type = "texts", or_single = true, default_doc = "none", doc = "numbers of types of elements that are left out, such as { \"117\" }" },
  },
}

local function damping()
  return { "damping", type = "number", unit = "s", range = { 0, 0.01 }, default = 0,
      doc = "stiffness-proportional damping (a time, not a ratio), or { mass = (1/s), stiffness = (s) }",
      or_table = {
        { "mass", type = "number", unit = "1/s", range = { 0, 1e6 }, default = 0, doc = "mass-proportional" },
        { "stiffness", type = "number", unit = "s", range = { 0, 0.01 }, default = 0, doc = "stiffness-proportional" },
      } },
    { "damping_ratio", type = "numbers", range = { 0, 1 }, at_least = 1, at_most = 2, or_single = true,
      doc = "instead of `damping`: fraction of critical damping at `damping_frequency` or over `damping_band`, 0.02 for 2 %; one for both frequencies, or one each" },
    { "damping_frequency", type = "numbers", unit = "Hz", range = { 1e-3, 1e8 }, at_least = 1, at_most = 2, or_single = true,
      doc = "frequency of the ratio: one (damping proportional to frequency), or two (least in between)" },
    { "damping_band", type = "numbers", unit = "Hz", range = { 1e-3, 1e8 }, at_least = 2, at_most = 2,
      doc = "instead of `damping_frequency`: the ratio, one, holds at all frequencies from the first to the second, within 5 %; "
        .. "the modulus then grows with frequency, and is the one given in static steps and in the middle of the band" }
end
local damping_time, damping_ratio, damping_frequency, damping_band = damping()
local density = { "density", type = "number", unit = "kg/m^3", range = { 10, 100000 }, required = true, doc = "mass per volume" }

local function modulus(name, doc) return { name, type = "number", unit = "Pa", range = { 1e3, 2e12 }, required = true, doc = doc } end
local function contraction(along, pulled)
  return { "nu" .. pulled .. along, type = "number", range = { -50, 50 }, usual = { -1, 1, ("is it nu%s%s, the contraction along %s of a bar pulled along %s?"):format(pulled, along, along, pulled) },
           required = true, doc = ("Poisson's ratio: contraction along %s of a bar pulled along %s; nu%s%s is nu%s%s e%s/e%s"):format(along, pulled, along, pulled, pulled, along, along, pulled) }
end

local function bears(name, doc, required)
  return { name, type = "number", unit = "Pa", range = { 1e3, 1e12 }, required = required, default_doc = not required and "required by \"tsai_wu\"" or nil, doc = doc }
end
local function coupling(axes) return { "f" .. axes, type = "number", range = { -1, 1 }, default = -0.5, doc = "coupling of the stresses along these axes (Tsai-Wu), as a share of its bound" } end

local strength = { "strength", type = "table",
  doc = "stresses that it bears along its axes: the run then monitors the failure index of its parts (1: failure; it grows with the load) and states the largest; the material stays elastic",
  fields = {
    bears("xt", "tension along axis 1", true), bears("xc", "compression along axis 1, positive", true),
    bears("yt", "tension along axis 2", true), bears("yc", "compression along axis 2, positive", true),
    bears("zt", "tension along axis 3"), bears("zc", "compression along axis 3, positive"),
    bears("s12", "shear in the plane of axes 1 and 2", true), bears("s13", "shear in the plane of axes 1 and 3"), bears("s23", "shear in the plane of axes 2 and 3", true),
    coupling "12", coupling "13", coupling "23",
  } }
local criterion = { "criterion", type = "choice", choices = { "tsai_wu", "hashin" }, default = "tsai_wu", with = "strength",
  doc = "of failure: \"hashin\" tells fibres from matrix, in tension and compression; it takes directions across the fibres as alike (xt, xc, yt, yc, s12, s23)" }

words[2] = {
  name = "material", doc = "Materials of substructures.",
  {
    "elastic", makes = "material", doc = "Isotropic linear elasticity.",
    arguments = {
      name_of "material",
      { "young", type = "number", unit = "Pa", range = { 1e6, 2e12 }, required = true, doc = "Young's modulus" },
      { "poisson", type = "number", range = { -0.9, 0.4999 }, usual = { 0, 0.4999, "metals have 0.25 to 0.35" }, required = true, doc = "Poisson's ratio" },
      density,
      { "yield", type = "number", unit = "Pa", range = { 1e5, 1e11 },
        doc = "yield stress: the run then monitors the von Mises stress of its parts and states the margin; the material stays elastic" },
      damping_time, damping_ratio, damping_frequency, damping_band,
    },
  },
  {
    "orthotropic", makes = "material",
    doc = "Linear elasticity with three planes of symmetry: a ply of fibres along axis 1, a honeycomb, plywood. Its axes are laid by the `orientation` of the "
      .. "substructure, else along x, y, z of the mesh.",
    arguments = {
      name_of "material",
      modulus("e1", "Young's modulus along axis 1"), modulus("e2", "Young's modulus along axis 2"), modulus("e3", "Young's modulus along axis 3"),
      contraction("2", "1"), contraction("3", "1"), contraction("3", "2"),
      modulus("g12", "shear modulus in the plane of axes 1 and 2"), modulus("g13", "shear modulus in the plane of axes 1 and 3"), modulus("g23", "shear modulus in the plane of axes 2 and 3"),
      density, strength, criterion, damping_time, damping_ratio, damping_frequency, damping_band,
    },
  },
  {
    "laminate", makes = "material",
    doc = "A layup of plies in one cell: hexahedra, each from face to face of the layup along axis 3 of the `orientation`. Strains in the plane are those of the cell, stresses across "
      .. "the plies go on from ply to ply; tension, bending and their coupling are those of lamination theory.",
    arguments = {
      name_of "material",
      { "plies", type = "tables", required = true, doc = "from the lowest along axis 3 to the highest, `{ material = ply, thickness = 0.125*mm, angle = 45*deg }`",
        fields = {
          { "material", type = "object", kinds = { "material" }, required = true, doc = "what it is made of; of `material.elastic` a `yield` counts as its strength" },
          { "thickness", type = "number", unit = "m", range = { 1e-7, 10 }, required = true, doc = "thickness; the sum is that of the cell" },
          { "angle", type = "number", range = { -7, 7 }, in_radians = true, default = 0, doc = "of its axis 1 from axis 1 of the layup towards axis 2, in radians: `45*deg`" },
        } },
      damping_time, damping_ratio, damping_frequency, damping_band,
    },
  },
}

words[3] = {
  name = "substructure", doc = "One linear elastic part of the assembly.",
  call = {
    makes = "substructure", doc = "A part: a mesh, a material and a place.",
    arguments = {
      name_of "part",
      { "mesh", type = "object", kinds = { "mesh" }, required = true, doc = "its body" },
      { "material", type = "object", kinds = { "material" }, required = true, doc = "what it is made of" },
      { "place", in_frame = "place", type = "placement", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 },
        doc = "translation of the mesh, { x, y, z }, or { translate = ..., rotate = { axis, angle, about } }: turned first, then moved",
        fields = {
          { "translate", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "translation" },
          { "rotate", type = "table", doc = "rotation before it", fields = {
            { "axis", type = "vector", required = true, doc = "direction of the axis; its length does not matter" },
            { "angle", type = "number", range = { -7, 7 }, in_radians = true, required = true, doc = "angle, in radians: `30*deg`" },
            { "about", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "a point of the axis" },
          } },
        } },
      frame "of `place` and `velocity`; the mesh turns with it",
      { "velocity", in_frame = "direction", type = "vector", unit = "m/s", range = { -20000, 20000 }, usual = usual_velocity, default = { 0, 0, 0 },
        doc = "velocity at the start of the first dynamic step" },
      { "orientation", type = "orientation", default_doc = "along x, y, z",
        doc = "of a material with directions, in the coordinates of the mesh, with which it turns (`place`, `pattern.circle`): { axis1, axis2 } (axis 2 in the plane of both, "
          .. "axis 3 across), a function of the middle of a cell (m) that returns axis1, axis2, or { axis = ... } of a cylinder: axis 1 around it, 2 along it, 3 outwards",
        fields = {
          { "axis", type = "vector", required = true, doc = "direction of the cylinder's axis; its length does not matter" },
          { "about", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "a point of it" },
          { "angle", type = "number", range = { -7, 7 }, in_radians = true, default = 0, doc = "by which axes 1 and 2 are turned about axis 3, in radians: 90*deg lays axis 1 along the cylinder" },
        } },
      { "integration", type = "choice", choices = { "implicit", "automatic", "explicit" }, default_doc = "as the solver has it",
        doc = "of its motion in dynamic steps of solver.latin: explicit needs no factor and uses as many increments per dt as its cells require" },
    },
  },
}

-- Beside the call: parts that are no mesh.
local part_arguments = words[3].call.arguments
words[3][1] = {
  "superelement", makes = "substructure",
  doc = "A part given by its matrices: from output.superelement or from another program. It takes part in interfaces, supports and "
    .. "all steps; it has no stress, and no joint inside it opens or slides. Its faces are those with which it was condensed. `file`, or `stiffness`, `mass` and `points`.",
  arguments = {
    name_of "part",
    { "file", type = "file", doc = "the `<name>.json` that output.superelement has written, beside its matrices" },
    { "stiffness", type = "file", doc = "symmetric, of points and modes: Matrix Market; Nastran's DMIG (`.pch`, `.bdf`) or OUTPUT4 as text (`.op4`); `.mtx` of Abaqus or CalculiX; "
      .. "CalculiX's `.sti`, with the `.dof` beside it" },
    { "mass", type = "file", doc = "the same rows (CalculiX: `.mas`)" },
    { "damping", type = "file", doc = "the same rows; left out: none" },
    { "points", type = "file", doc = "table (CSV) of the interface's points with a line of titles: face, x, y, z; node, the number of each, where the matrices name their rows "
      .. "by nodes; else row_x, row_y, row_z, the numbers of their rows, where these are not in the order of the table" },
    { "stiffness_name", type = "text", default_doc = "the only one that begins with K", doc = "of the matrix in a file of several (Nastran)" },
    { "mass_name", type = "text", default_doc = "the only one that begins with M", doc = "the same" },
    { "damping_name", type = "text", default_doc = "the only one that begins with B, C or D", doc = "the same" },
    { "units", type = "choice", choices = { "m kg s", "mm t s", "mm kg ms", "in lbf s" }, default_doc = "`\"m kg s\"`, in Matrix Market format; others must say",
      doc = "of length, mass and time (of length, force and time) in matrices and points" },
    { "total_mass", type = "number", unit = "kg", range = { 1e-9, 1e9 }, doc = "of the body, to check the units: refused if the matrices are off by more than 1 %" },
    part_arguments[4], part_arguments[5], part_arguments[6],
  },
  one_of = { "file", "stiffness" },
}

-- What declares a body by its mass; `inertia` is required where it has no default.
local function of_mass(where, default_inertia, ...)
  return {
    name_of "part",
    on({ "face" }, where),
    { "mass", type = "number", unit = "kg", range = { 1e-9, 1e9 }, required = true, doc = "of the body" },
    { "inertia", in_frame = "inertia", type = "numbers", unit = "kg m^2", at_least = 3, at_most = 6, required = not default_inertia or nil, default_doc = default_inertia,
      doc = "moments about its centre of mass { xx, yy, zz }, or with { ..., xy, xz, yz }, the products with their minus, as the matrix has them" },
    { "at", in_frame = "point", type = "vector", unit = "m", range = { -1000, 1000 }, required = true, doc = "its centre of mass" },
    ...
  }
end

words[3][2] = {
  "rigid", makes = "substructure",
  doc = "A rigid body, such as an equipment box on its feet: a mass and its inertia attached to faces of other parts. Its faces have the names of those in `on` (with the part in front where two have one name), those picked by geometry also \"face 1\", \"face 2\" ... by their place there; "
    .. "an interface joins each to the face that it lies on: `interface.bonded{ name = \"feet\", between = { panel:face \"feet\", box:face \"feet\" } }`.",
  arguments = of_mass("faces of parts that it touches; they are stiff as far as they are joined to it", nil,
    frame "of `at` and `velocity`, and along whose axes `inertia` is", part_arguments[6]),
}

words.mass = {
  name = "mass", doc = "Masses in the place of equipment: listed among `substructures`, and joined to the faces that they are on.",
  {
    "point", makes = "substructure", is_mass = true,
    doc = "A mass with its inertia on a face, as a box or a dummy on its feet: `substructure.rigid` and the bond to each face in one. A problem that lists it has its bonds; `box.joints` is the list of them, for outputs. "
      .. "Several faces are joined each by itself.",
    arguments = of_mass("faces of parts that carry it", "that of a ball of a thousandth of the size of its faces",
      { "motion", type = "choice", choices = { "mean", "rigid" }, default = "mean",
        doc = "what it follows: the mean motion of a face, translation and rotation, in which the face deforms freely (RBE3); or all of the face, which then stays rigid (RBE2)" },
      { "weights", type = "choice", choices = { "area", "nodes" }, default = "area", doc = "what counts in a mean motion: the area behind each node, or each node alike" },
      frame "of `at` and `velocity`, and along whose axes `inertia` is", part_arguments[6]),
  },
}

words.frame = {
  name = "frame",
  doc = "A local coordinate system: an origin and three orthogonal axes. Places, directions and components of anything that takes it as `frame` are in its axes.",
  call = {
    makes = "frame", doc = "A local coordinate system. `f.x`, `f.y`, `f.z` and `f.origin` are its axes and its origin in the axes of the deck.",
    arguments = {
      { "origin", in_frame = "point", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "its origin" },
      { "axis", type = "vector", default = { 0, 0, 1 }, doc = "its z axis; the length does not matter" },
      { "x", type = "vector", default_doc = "x, or y where the axis is along x", doc = "direction of its x axis, of which what lies across `axis` counts" },
      { "angle", type = "number", range = { -7, 7 }, in_radians = true, default = 0, doc = "by which x and y are then turned about `axis`, in radians: `17*deg`" },
      frame "in whose axes the other arguments are",
    },
  },
}

local function pattern_of(n_doc)
  return { "of", type = "object", kinds = { "substructure" }, or_bolt = true, required = true,
           doc = "the part, or a bolt with all its parts; it is the first of the list" },
    { "n", type = "integer", range = { 1, 10000 }, required = true, doc = n_doc }
end
local circle_of, circle_n = pattern_of "number of copies, evenly around the axis"
local line_of, line_n = pattern_of "number of copies"

words.pattern = {
  name = "pattern", doc = "Equal parts, as a list of substructures: one mesh for all.",
  {
    "circle", makes = "list of substructures", expands = true, doc = "A part n times around an axis, called `name[1]` ... `name[n]`.",
    arguments = {
      circle_of, circle_n,
      { "axis", type = "vector", required = true, doc = "direction of the axis; its length does not matter" },
      { "about", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "a point of the axis" },
      { "angle", type = "number", range = { -7, 7 }, in_radians = true, default_doc = "360 deg / n", doc = "from one to the next, in radians" },
    },
  },
  {
    "line", makes = "list of substructures", expands = true, doc = "A part n times in a row, called `name[1]` ... `name[n]`.",
    arguments = {
      line_of, line_n,
      { "step", type = "vector", unit = "m", range = { -1000, 1000 }, required = true, doc = "from one to the next" },
    },
  },
}

words.field = {
  name = "field", doc = "Functions of a place from files.",
  {
    "file", makes = "field", is_scan = true, keeps_frame = true, returns = "fun(x: number, y: number, z: number): number",
    doc = "A measured face, for `gap`: a function of x, y, z (m) that answers a height (m) from a file of three columns, two places and a height, in any order of points; separators and titles with units as in history.file. "
      .. "Between points the plane that fits those around best, weighted by exp(-(distance/smooth)^2). A gap is where a face is low: `gap = function(x, y, z) return -scan(x, y, z) end` of a height of material.",
    arguments = {
      { "file", type = "file", required = true, doc = "path, relative to the deck's folder" },
      { "plane", type = "choice", choices = { "xy", "yz", "zx", "yx", "zy", "xz" }, default = "xy", doc = "the axes along which the places are, in the order of the columns" },
      { "unit", type = "number", unit = "m", range = { 1e-9, 1000 }, default_doc = "of the titles", doc = "length of one unit of the places" },
      { "height_unit", type = "number", unit = "m", range = { 1e-9, 1000 }, default_doc = "of the titles", doc = "length of one unit of the heights" },
      { "smooth", type = "number", unit = "m", range = { 0, 1 }, default = 0, doc = "length over which heights are smoothed; 0: the distance between points" },
      frame "in whose axes the places are",
    },
  },
}

local bolts = native.module "bolts"
local bolt_material = { "material", type = "object", kinds = { "material" }, required = true, doc = "of all its parts" }
local function bolt_size() return { "size", type = "choice", choices = bolts.sizes, required = true, doc = "of the thread" } end
local function of_bolts()
  return { "washer", type = "boolean", default = true, doc = "under head and nut" },
    { "friction", type = "number", range = { 0, 1000 }, usual = friction.usual, default = 0.15, doc = "of the washers against head and nut" },
    { "shank", type = "choice", choices = { "stress", "nominal" }, default = "stress",
      doc = "diameter of the shank: of the thread's stress area (ISO 898-1), for bolts threaded over their grip, or nominal" },
    { "yield", type = "number", unit = "Pa", range = { 1e3, 1e11 }, doc = "the shank's interface is then interface.plastic, else bonded" },
    { "hardening", type = "number", unit = "Pa/m", range = { 0, 1e17 }, default = 0, doc = "of it" },
    { "around", type = "integer", range = { 12, 240 }, default = 12, doc = "cells around the shank, a multiple of 12; lengths of cells follow" },
    { "order", type = "integer", range = { 1, 2 }, default = 1, doc = "of the shape functions: hex8, or hex20 with round edges" },
    { "integration", type = "choice", choices = { "implicit", "automatic", "explicit" }, default_doc = "as the solver has it", doc = "as of a substructure" }
end

words.bolt = {
  name = "bolt", doc = "Standard bolts, meshed: parts, faces and interfaces at once.",
  {
    "hex", makes = "bolt", is_bolt = true,
    doc = "A hexagon bolt with nut and washers (ISO 4014 and 4017, 4032, 7089), of hexahedra around z. z = 0 is the upper clamped face; the head is above, "
      .. "the nut at -grip. Its own interfaces join its parts; the deck must join it to the clamped parts.",
    arguments = {
      { "name", type = "name", required = true, doc = "of the bolt: its parts are `name head`, `name nut`, `name washer 1`, `name washer 2`, the shank's interface `name`" },
      bolt_size(),
      { "grip", type = "number", unit = "m", range = { 1e-4, 2 }, required = true, doc = "clamped thickness, without the washers" },
      bolt_material,
      { "place", in_frame = "place", type = "placement", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "as of a substructure",
        fields = words[3].call.arguments[4].fields },
      frame "of `place`; the bolt stands along its z axis",
      of_bolts(),
    },
  },
  {
    "through", makes = "list of bolts", is_bolt = true, is_through = true, keeps_frame = true,
    doc = "Hexagon bolts as of bolt.hex, `name[1]` ..., one in each round hole that runs through the parts: axis, grip and places come from the meshes. "
      .. "In the order of x, then y, then z of the heads, along the axes of `frame`.",
    arguments = {
      { "name", type = "name", required = true, doc = "of the bolts: `name[1]`, `name[2]`, ..." },
      bolt_size(),
      { "parts", type = "objects", kinds = { "substructure" }, at_least = 1, or_names = true, required = true,
        doc = "clamped parts, or names of them (* stands for any text), the first under the head; a hole may pass only some of the others" },
      { "radius", type = "number", unit = "m", range = { 1e-4, 0.5 }, default_doc = "any that the thread passes with up to 30 % to spare",
        doc = "of the holes, within two per cent" },
      { "where", in_frame = "function", type = "function", doc = "function(x, y, z), in metres, true for the end of a hole under the head: those holes alone" },
      frame "of `where` and `head`; its axes are those that the bolts' hexagons and order turn with",
      { "head", in_frame = "direction", type = "vector", default_doc = "z, else y, else x", doc = "of a single part: direction towards the heads" },
      { "n", type = "integer", range = { 1, 10000 }, doc = "how many holes there must be" },
      bolt_material, of_bolts(),
    },
  },
}

words[4] = {
  name = "interface", doc = "Where two substructures meet; everything nonlinear happens here.",
  {
    "bonded", makes = "interface", tightens = true, doc = "A perfect bond.",
    arguments = {
      name_unless_all(), between(all_touching), of_parts, except, within(), points(),
      { "motion", type = "choice", choices = { "points", "mean" }, default = "points",
        doc = "what is joined: the faces point by point; or their mean motions alone, translation and rotation (RBE3), between which both faces deform freely and may lie apart" },
      { "weights", type = "choice", choices = { "area", "nodes" }, default = "area", doc = "what counts in a mean motion: the area behind each node, or each node alike" },
    },
  },
  {
    "cyclic", makes = "interface",
    doc = "The cut faces of one sector of a ring, under what is the same in all sectors (tightening, pressure, shocks along the axis): they move alike, the second turned "
      .. "about the axis. One for each part that is cut. Meshes need not match.",
    arguments = {
      name_of "interface",
      { "between", type = "between", kinds = { "face" }, exactly = 2, required = true,
        doc = "the two cut faces; the first is side 1, on which resultants are counted" },
      { "axis", in_frame = "direction", type = "vector", required = true, doc = "direction of the ring's axis; its length does not matter" },
      { "through", in_frame = "point", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "a point of the axis" },
      { "n", type = "integer", range = { 2, 10000 }, required = true, doc = "sectors of the whole ring" },
      frame "of `axis` and `through`", within(),
    },
  },
  {
    "contact", makes = "interface", doc = "Unilateral contact with Coulomb friction.",
    arguments = {
      name_unless_all(), between(all_touching), of_parts, except, friction_of_contact,
      { "gap", type = "number", unit = "m", range = { -0.01, 0.01 }, usual = usual_gap, default = 0, or_word = "geometry", or_function = true,
        doc = "initial gap; a negative one is an interference; \"geometry\": the actual distance, point by point, for non-matching meshes; a function: the gap (m) "
          .. "at a place, added to that distance (crowned, wavy, measured faces); where 0, cylinders around one axis, and named faces of which one is a cylinder or a sphere and the other plane, keep the gap that is drawn" },
      { "compliance", type = "compliance", default_doc = "none",
        doc = "rough faces, whose asperities deform before the bodies are fully in contact: one of `normal`, `curve` and `asperities`",
        fields = {
          { "normal", type = "number", unit = "Pa/m", range = { 1e3, 1e18 }, doc = "pressure per approach of the faces" },
          { "curve", type = "pairs", of = { "approach", "pressure" }, doc = "pairs of approach (m) and pressure (Pa) from (0, 0) on, straight in between and beyond the last" },
          { "asperities", type = "table", doc = "elastic tips, their heights spread evenly", fields = {
            { "radius", type = "number", unit = "m", range = { 1e-9, 1 }, required = true, doc = "of the tips" },
            { "density", type = "number", unit = "1/m^2", range = { 1, 1e18 }, required = true, doc = "tips per area" },
            { "height", type = "number", unit = "m", range = { 1e-9, 1e-2 }, required = true, doc = "between the highest tip and the lowest" } } },
          { "tangential", type = "number", unit = "Pa/m", range = { 1e3, 1e18 }, default_doc = "2 (1 - nu)/(2 - nu) of the normal slope (Mindlin)",
            doc = "traction per tangential displacement below the limit of friction" },
        } },
      { "closed", type = "boolean", default = false, doc = "confirms that the faces touch, whatever lies between them: the gap is 0" },
      within(), points(),
    },
  },
  {
    "plastic", makes = "interface", tightens = true,
    doc = "A bond that yields along its normal, as a bolt does; unloading and reloading are rigid.",
    arguments = {
      name_of "interface", between(), within(), points(),
      { "yield", type = "number", unit = "Pa", range = { 1e3, 1e11 }, required = true, doc = "normal traction at yield" },
      { "hardening", type = "number", unit = "Pa/m", range = { 0, 1e17 }, default = 0,
        doc = "traction per metre of plastic opening: H/L for an axial modulus H over a shank of length L" },
      { "compression", type = "boolean", default = false, doc = "yields in compression too, with isotropic hardening" },
    },
  },
  {
    "viscous", makes = "interface",
    doc = "A damper, such as a gasket or a layer of grease: a traction proportional to the relative velocity, in tension and compression. "
      .. "It carries no load in a static step.",
    arguments = {
      name_of "interface", between(), within(), points(),
      { "normal", type = "number", unit = "Pa s/m", range = { 0, 1e12 }, required = true,
        doc = "traction per relative velocity along the normal: viscosity / thickness of a layer; 0: free" },
      { "tangential", type = "number", unit = "Pa s/m", range = { 0, 1e12 }, default = 0, doc = "the same along the tangents; 0: free" },
    },
  },
  {
    "bushing", makes = "interface", tightens = true,
    doc = "A linear spring and damper, as an isolator, a gasket or an adhesive layer (CBUSH): a traction in proportion to the relative "
      .. "displacement and velocity, pulling and pushing.",
    arguments = {
      name_of "interface", between(), within(), points(),
      { "normal", type = "number", unit = "Pa/m", range = { 1, 1e18 }, required = true,
        doc = "traction per relative displacement along the normal: modulus / thickness of a layer, stiffness / area of a mount" },
      { "tangential", type = "number", unit = "Pa/m", range = { 0, 1e18 }, default = 0, doc = "the same along the tangents; 0: free" },
      { "normal_damping", type = "number", unit = "Pa s/m", range = { 0, 1e12 }, default = 0, doc = "traction per relative velocity along the normal" },
      { "tangential_damping", type = "number", unit = "Pa s/m", range = { 0, 1e12 }, default = 0, doc = "the same along the tangents" },
      { "loss", type = "number", range = { 0, 2 }, default = 0, with = "frequency",
        doc = "loss factor of the stiffness at `frequency`, turned into damping, loss stiffness / (2 pi frequency), and added to it" },
      { "frequency", type = "number", unit = "Hz", range = { 1e-3, 1e8 }, default = 0, default_doc = "none", doc = "where `loss` holds" },
    },
  },
  {
    "iwan", makes = "interface",
    doc = "A lap joint with microslip (Iwan's model with Segalman's four parameters): bonded along the normal; along the tangents, elastic sliders in "
      .. "parallel that slip one after the other, the weakest at any load. Its limit does not depend on the normal force.",
    arguments = {
      name_of "interface", between(), within(), points(),
      { "slip", type = "number", unit = "Pa", range = { 1, 1e11 }, required = true, doc = "traction at macroslip: force over area" },
      { "stiffness", type = "number", unit = "Pa/m", range = { 1, 1e18 }, required = true, doc = "traction per relative displacement of a small motion: the initial stiffness" },
      { "chi", type = "number", range = { -0.99, 0 }, required = true, doc = "the energy loss of a small cycle grows with its amplitude to the power 3 + chi" },
      { "beta", type = "number", range = { 0, 1000 }, required = true, doc = "stiffness lost at macroslip over that lost before it" },
      { "sliders", type = "integer", range = { 2, 200 }, default = 30, doc = "bands of the distribution; more are smoother and cost more" },
    },
  },
}

-- Interfaces that a load can shorten, as a nut does.
local tightened = {}
for _, entry in ipairs(words[4]) do
  if entry.tightens then table.insert(tightened, "interface." .. entry[1]) end
end

words[5] = {
  name = "support", doc = "Rigid supports of the assembly.",
  {
    "fixed", makes = "support", doc = "No displacement.",
    arguments = { name_of "support", on({ "face", "region" }, "what is held") },
  },
  {
    "symmetry", makes = "support", doc = "No displacement along the normal.",
    arguments = { name_of "support", on({ "face" }, "faces on the plane of symmetry") },
  },
  {
    "held", makes = "support", doc = "No displacement along some of the axes x, y and z.",
    arguments = {
      name_of "support", on({ "face", "region" }, "what is held"),
      { "x", in_frame = "held", type = "boolean", default = false, doc = "along x" },
      { "y", in_frame = "held", type = "boolean", default = false, doc = "along y" },
      { "z", in_frame = "held", type = "boolean", default = false, doc = "along z" },
      frame "along whose axes x, y and z are: all three, or those of a plane of the deck",
    },
  },
  {
    "equation", makes = "support",
    doc = "A linear equation between motions: along x, y or z, each asked for by itself, the sum of each factor times the mean displacement of its place is zero "
      .. "(*EQUATION, MPC). It joins places of one part, or of two; with one place it holds the mean motion of that.",
    arguments = {
      name_of "support", on({ "face", "region" }, "its terms: faces, which move as their mean by area does, or regions, as the mean of their nodes"),
      { "factors", type = "numbers", or_single = true, at_least = 1, range = { -1e9, 1e9 }, default_doc = "`terms`", doc = "one a place: { 1, -1 } makes two places move alike" },
      { "x", in_frame = "own_axes", type = "boolean", default = false, doc = "along x" },
      { "y", in_frame = "own_axes", type = "boolean", default = false, doc = "along y" },
      { "z", in_frame = "own_axes", type = "boolean", default = false, doc = "along z" },
      { "terms", in_frame = "own_axes", type = "tables", default_doc = "`factors`",
        doc = "one equation whose terms are along several axes, instead of `factors` and `x`, `y`, `z`: one a place, { { x = 2 }, { y = -1, z = 0.5 } }",
        fields = {
          { "x", type = "number", range = { -1e9, 1e9 }, default = 0, doc = "factor of the motion along x" },
          { "y", type = "number", range = { -1e9, 1e9 }, default = 0, doc = "along y" },
          { "z", type = "number", range = { -1e9, 1e9 }, default = 0, doc = "along z" },
        } },
      frame "along whose axes x, y and z are",
    },
  },
  {
    "spring", makes = "support",
    doc = "Springs, and dampers beside them, along x, y and z and about them: between the mean motions of two places (*SPRING, CELAS, CBUSH), or of one and the ground. "
      .. "Where two places are apart, a spring across the line between them leaves the moment of its two forces unbalanced: such springs belong between places at one point.",
    arguments = with_springs({
      name_of "support",
      { "on", type = "objects", kinds = { "face", "region" }, at_least = 1, or_single = true, required = true,
        doc = "one place or two: faces, which move as their mean by area does, or regions, as the mean of their nodes" },
    }, frame "along whose axes x, y and z are"),
  },
  {
    "wall", makes = "support", doc = "A rigid wall: unilateral contact with friction.",
    arguments = {
      name_of "support", on({ "face" }, "faces that may touch the wall"), friction,
      { "gap", type = "number", unit = "m", range = { -0.01, 0.01 }, usual = { -0.0005, 0.01, usual_gap[3] }, default = 0, doc = "initial gap" },
    },
  },
  {
    "absorbing", makes = "support", doc = "Non-reflecting boundary: waves leave as if the part were infinite.",
    arguments = { name_of "support", on({ "face" }, "where waves leave") },
  },
}

words[6] = {
  name = "load", 
  doc = "What acts during the steps that list it. Every value is a number, a history or a function of time; in a static step a "
    .. "number is ramped over the increments.",
  {
    "pressure", makes = "load", doc = "Normal pressure; a positive one pushes.",
    arguments = {
      on({ "face" }, "loaded faces"),
      { "history", type = "value", unit = "Pa", range = { -1e11, 1e11 }, required = true, doc = "the pressure" },
    },
  },
  {
    "traction", makes = "load", doc = "Force per area, in fixed directions.",
    arguments = { on({ "face" }, "loaded faces"), components_in_frame("traction", "Pa", { -1e11, 1e11 }) },
    one_of = { "x", "y", "z" },
  },
  {
    "force", makes = "load", doc = "A total force, spread evenly over the combined area of all faces of `on`, or over the nodes of its regions.",
    arguments = { on({ "face", "region" }, "loaded faces or nodes"), components_in_frame("force", "N", { -1e10, 1e10 }) },
    one_of = { "x", "y", "z" },
  },
  {
    "torque", makes = "load",
    doc = "A moment about an axis, right-handed, spread over a face as tractions that grow with the radius, around the axis where it is across the face or `through` is given.",
    arguments = {
      on({ "face" }, "twisted faces: each gets the torque"),
      { "axis", in_frame = "direction", type = "vector", required = true, doc = "direction of the axis; its length does not matter" },
      { "through", in_frame = "point", type = "vector", unit = "m", range = { -1000, 1000 }, default_doc = "the centroid of the face", doc = "a point of the axis" },
      { "history", type = "value", unit = "N m", range = { -1e9, 1e9 }, required = true, doc = "the torque" },
      frame "of `axis` and `through`",
    },
  },
  {
    "velocity", makes = "load", doc = "Prescribed velocity; a direction left out is free.",
    arguments = { on({ "face", "region" }, "driven faces or nodes"), motion_in_frame("velocity", "m/s", { -20000, 20000 }, usual_velocity) },
    one_of = { "x", "y", "z" },
  },
  {
    "displacement", makes = "load", doc = "Prescribed displacement; a direction left out is free.",
    arguments = { on({ "face", "region" }, "driven faces or nodes"), motion_in_frame("displacement", "m", { -0.1, 0.1 }) },
    one_of = { "x", "y", "z" },
  },
  {
    "base_acceleration", makes = "load", doc = "Acceleration of a support, as on a shaker or a shock table.",
    arguments = {
      on({ "support" }, "driven supports"),
      { "direction", in_frame = "direction", type = "vector", required = true, doc = "direction; its length does not matter" },
      frame "of `direction`",
      { "history", type = "value", unit = "m/s^2", range = { -1e9, 1e9 }, usual = usual_acceleration, required = true, doc = "the acceleration" },
    },
  },
  {
    "gravity", makes = "load", doc = "A uniform acceleration field on every substructure.",
    arguments = { components_in_frame("acceleration", "m/s^2", { -1e7, 1e7 }, usual_acceleration) },
    one_of = { "x", "y", "z" },
  },
  {
    "spin", makes = "load",
    doc = "Centrifugal force on every substructure at a constant speed about an axis: per volume, density times speed squared times the distance from the axis. "
      .. "Static steps only; stress stiffening and spin softening are neglected. The force is ramped linearly over the step.",
    arguments = {
      { "speed", type = "number", unit = "rad/s", range = { 0, 1e6 }, required = true, doc = "`3000*2*math.pi/60` is 3000 turns a minute" },
      { "axis", in_frame = "direction", type = "vector", required = true, doc = "direction of the axis; its length does not matter" },
      { "through", in_frame = "point", type = "vector", unit = "m", range = { -1000, 1000 }, default = { 0, 0, 0 }, doc = "a point of the axis" },
      frame "of `axis` and `through`",
    },
  },
  {
    "temperature", makes = "load",
    doc = "A uniform temperature change of parts: they expand, and are stressed where the expansion is constrained (a bar between walls: -E expansion by). "
      .. "Stresses in the results exclude the free expansion. A later step that does not list it takes the parts back to their stress-free temperature.",
    arguments = {
      { "parts", type = "objects", kinds = { "substructure" }, at_least = 1, required = true, doc = "which: of cells and a material that is the same in all directions" },
      { "expansion", type = "number", unit = "1/K", range = { -1e-3, 1e-3 }, required = true, doc = "coefficient of thermal expansion: 12e-6 for steel, 23e-6 for aluminium" },
      { "by", type = "value", unit = "K", range = { -5000, 5000 }, required = true, doc = "temperature above the stress-free one" },
    },
  },
  {
    "mode", makes = "load",
    doc = "Forces in the shape of a mode that `output.modes` has found in an earlier step of the run: mass times shape, whose largest displacement is one, times an acceleration. "
      .. "With `output.backbone` in static steps; with a release in a dynamic step the mode rings.",
    arguments = {
      { "mode", type = "object", kinds = { "output.modes" }, required = true, doc = "the modes" },
      { "number", type = "integer", range = { 1, 2000 }, required = true, doc = "which of them, as in its table; those at 0 Hz come first" },
      { "parts", type = "objects", kinds = { "substructure" }, at_least = 1, required = true, doc = "the parts that are loaded: all, for the mode alone" },
      { "value", type = "value", unit = "m/s^2", range = { -1e7, 1e7 }, required = true, doc = "acceleration where the shape is largest" },
    },
  },
  {
    "shortening", makes = "load",
    doc = "Draws the two sides of an interface together by a length, as a nut does; frozen at the end of the step.",
    arguments = {
      on(tightened, "shortened interfaces"),
      { "by", type = "value", unit = "m", range = { -0.01, 0.01 }, required = true, doc = "a positive one tightens" },
      share_of_bolt "the whole bolt of `hand` and `size`", by_hand, rating_of_bolt(),
    },
  },
  {
    "preload", makes = "load",
    doc = "Tightens until a force acts through the interface; the shortening is found, and frozen at the end of the step. Static "
      .. "steps only. `force`, or `torque` with `friction_factor` and `diameter`: torque / (friction_factor diameter).",
    arguments = {
      on(tightened, "tightened interfaces: each gets the force"),
      { "force", type = "value", unit = "N", range = { 0, 1e8 },
        doc = "through the modelled interface (a quarter model takes a quarter), ramped from its current force" },
      { "torque", type = "number", unit = "N m", range = { 0, 1e6 }, doc = "on the nut or head of the whole bolt" },
      { "friction_factor", type = "number", range = { 0.01, 1 }, doc = "nut factor K; about 0.2 for dry steel" },
      { "diameter", type = "number", unit = "m", range = { 1e-4, 0.5 }, doc = "nominal, of the thread" },
      share_of_bolt "the whole bolt of `torque`, `hand` and `size`", by_hand, rating_of_bolt(),
    },
  },
  {
    "release", makes = "load", doc = "Releases an interface: separation.",
    arguments = {
      on({ "interface" }, "released interfaces"),
      { "at", type = "number", unit = "s", range = { 0, 100 }, required = true,
        doc = "when, from the start of the step (from 0 to 1 in a static one)" },
    },
  },
}

words[7] = {
  name = "history", 
  doc = "A value that depends on time, counted from the start of the step (from 0 to 1 in a static one). Any `function(t)` "
    .. "is accepted as well. Histories and functions can be scaled and added, `2*signal`, `-signal`, `signal/3`, `signal*g0`, `signal + other`, "
    .. "`signal - 5`, and `signal(t)` is the value at a time.",
  {
    "constant", makes = "history", doc = "The same at all times.",
    arguments = { { "value", type = "number", range = any_value, required = true, doc = "the value" } },
  },
  {
    "step", makes = "history", doc = "Zero, then a value.",
    arguments = {
      { "value", type = "number", range = any_value, required = true, doc = "value from then on" },
      { "at", type = "number", unit = "s", range = { 0, 100 }, default = 0, doc = "when" },
    },
  },
  {
    "ramp", makes = "history", doc = "Linear from one value to another, then constant.",
    arguments = {
      { "from", type = "number", range = any_value, default = 0, doc = "value at 0" },
      { "to", type = "number", range = any_value, required = true, doc = "value at the end" },
      { "duration", type = "number", unit = "s", range = duration, required = true, doc = "how long it rises" },
    },
  },
  {
    "half_sine", makes = "history", doc = "peak sin(pi t / duration), then zero.",
    arguments = {
      { "peak", type = "number", range = any_value, required = true, doc = "largest value" },
      { "duration", type = "number", unit = "s", range = duration, required = true, doc = "of the pulse" },
    },
  },
  {
    "haversine", makes = "history", doc = "peak sin^2(pi t / duration), then zero.",
    arguments = {
      { "peak", type = "number", range = any_value, required = true, doc = "largest value" },
      { "duration", type = "number", unit = "s", range = duration, required = true, doc = "of the pulse" },
    },
  },
  {
    "pulse", makes = "history", doc = "A trapezoid from zero, then zero.",
    arguments = {
      { "peak", type = "number", range = any_value, required = true, doc = "value of the plateau" },
      { "rise", type = "number", unit = "s", range = { 0, 100 }, required = true, doc = "how long it rises" },
      { "hold", type = "number", unit = "s", range = { 0, 100 }, required = true, doc = "how long it stays" },
      { "fall", type = "number", unit = "s", range = { 0, 100 }, required = true, doc = "how long it falls" },
    },
  },
  {
    "piecewise", makes = "history", doc = "Linear between points, constant outside.",
    arguments = {
      { "times", type = "numbers", unit = "s", at_least = 2, required = true, doc = "instants, increasing" },
      { "values", type = "numbers", at_least = 2, required = true, doc = "as many values" },
    },
  },
  {
    "file", makes = "history",
    doc = "Two columns, time and value, separated by semicolons, tabs, commas or blanks, linear in between; constant beyond its ends. Decimals have a "
      .. "point, or a comma if commas do not separate columns. Its titles may give units, `time [ms], acceleration (g)`, or a line below them; without units, times are in seconds, and an acceleration requires `unit`.",
    arguments = {
      { "file", type = "file", required = true, doc = "path, relative to the deck's folder" },
      { "column", type = "text", doc = "title of the column of values, without its unit, if the file has several; the first column is the time" },
      { "unit", type = "number", range = { 1e-12, 1e12 }, doc = "SI value of one unit of the file, if the file does not state it: `unit = g0`, `unit = kN`, `unit = 1`" },
    },
  },
}

local loads = { "loads", type = "objects", kinds = { "load" }, default = {}, doc = "what acts" }
local step_supports = { "supports", type = "objects", kinds = { "support" },
                        doc = "replaces the problem's in this step: an omitted support is released" }
local after = { "after", type = "object", kinds = { "step" },
                doc = "the step before; left out: from the undeformed state" }

words[8] = {
  name = "step", doc = "The stages of a computation.",
  {
    "static", makes = "step", doc = "Equilibrium, in increments.",
    arguments = {
      name_of "step", after,
      { "increments", type = "integer", range = { 1, 100000 }, default = 1, doc = "number of increments" },
      { "inertia_relief", type = "boolean", default = false,
        doc = "inertia balances the loads on whatever nothing holds, which accelerates as a rigid body: a rocket under thrust, a free-free assembly" },
      loads, step_supports,
    },
  },
  {
    "dynamic", makes = "step", doc = "Motion, in equal time steps.",
    arguments = {
      name_of "step", after,
      { "duration", type = "number", unit = "s", range = duration, required = true, doc = "how long" },
      { "dt", type = "number", unit = "s", range = { 1e-12, 0.1 }, default_doc = "20 time steps, 40 with friction, a period of the highest frequency that loads bring or outputs ask for, else of what the mesh carries",
        doc = "time step" },
      loads, step_supports,
    },
  },
}

words[9] = {
  name = "solver", doc = "Solution methods. Every parameter has a good default, so most decks give none.",
  {
    "latin", makes = "solver", doc = "The LATIN method.",
    arguments = {
      { "tolerance", type = "number", range = { 1e-14, 0.1 }, default = 1e-6, doc = "indicator at which a time step has converged" },
      { "static_tolerance", type = "number", range = { 1e-14, 0.1 }, default = 1e-8, doc = "the same in static steps" },
      { "window", type = "integer", range = { 1, 1e9 }, default = 1, or_word = "whole",
        doc = "time steps iterated together; \"whole\": the whole step" },
      { "relaxation", type = "number", range = { 0.05, 1 }, default_doc = "0.95; 0.8 in static steps and windows of several steps",
        doc = "of the linear stage" },
      { "anderson", type = "integer", range = { 0, 100 }, default_doc = "10; 40 in static steps; 5 in windows, 0 beyond 20 steps",
        doc = "depth of Anderson's acceleration; 0: none" },
      { "max_iterations", type = "integer", range = { 1, 1000000 }, default_doc = "200, in static steps 400, and on to ten times as many while they help",
        doc = "of an increment or a window" },
      { "numerical_damping", type = "number", range = { 0, 1 }, default = 0, doc = "of the time scheme; 0: none" },
      { "push_out", type = "number", range = { 0, 1 }, default = 0, doc = "fraction of a penetration removed per time step" },
      { "search_direction", type = "number", range = { 1e-6, 1e6 }, default = 1, doc = "multiplies every search direction" },
      { "mass", type = "choice", choices = { "automatic", "tuned", "lumped" }, default = "automatic",
        doc = "of the cells: tuned to the time scheme so that waves keep their speed, or lumped at the nodes; \"automatic\": tuned in explicit substructures of "
          .. "hexahedra in which lumped mass would delay waves, else lumped" },
      { "massless_contact", type = "boolean", default = false,
        doc = "moves the mass of contact nodes to those behind them: impacts then dissipate no energy" },
      { "integration", type = "choice", choices = { "implicit", "automatic", "explicit" }, default = "automatic",
        doc = "of substructures in dynamic steps; \"automatic\": explicit where cheaper; \"explicit\": wherever possible" },
      { "precision", type = "choice", choices = { "single", "double" }, default_doc = "single in substructures of more than 1000 unknowns, unless tolerance is below 1e-7 or a window has more than 5 time steps",
        doc = "of the stored factors in dynamic steps; arithmetic is always in double precision. Implicit parts cost less in single, which integration = \"automatic\" takes into account" },
      { "pieces", type = "integer", range = { 1, 100000 }, default = "auto", or_word = "auto",
        doc = "number of bonded pieces of each substructure; 1: none is cut; \"auto\": large ones are, and others to balance MPI load" },
      { "history_memory", type = "number", range = { 0, 1e6 }, default = 512,
        doc = "MB of interface fields kept in memory for `start_from`; the rest goes to a temporary file" },
      { "spectra", type = "number", range = { 1e-4, 20 }, default_doc = "one run at `tolerance`",
        doc = "dB: the run is computed in passes, each ten times tighter, from a tolerance of 1e-3, until no output.srs changes by this much "
          .. "or `tolerance` is reached" },
      { "static_steps", type = "choice", choices = { "automatic", "assembled", "iterated" }, default = "automatic",
        doc = "assembled: all parts in one system, refactorised where contact changes much; a few tens of iterations for any connectivity. iterated: part "
          .. "by part, as in dynamic steps. automatic: assembled where 10 parts or more are joined and in sectors of rings, in steps of at most 5 increments, "
          .. "and where an increment part by part has not converged in 400 iterations" },
      { "plain", type = "boolean", default = false, doc = "iterates with full solves, to verify the condensed ones" },
    },
  },
  {
    "monolithic", makes = "solver",
    doc = "The whole assembly in one implicit system, contact and plasticity by Newton's method: a check of LATIN. Dense in the "
      .. "unknowns of contact, plastic and shortened interfaces, for which there is a limit.",
    arguments = {
      { "tolerance", type = "number", range = { 1e-14, 0.1 }, default = 1e-10, doc = "relative residual at which an increment has converged" },
      { "max_iterations", type = "integer", range = { 1, 1000000 }, default = 50, doc = "of one increment; a static one may use up to twice as many before" },
      { "numerical_damping", type = "number", range = { 0, 1 }, default = 0, doc = "of the time scheme; 0: none" },
      { "mass", type = "choice", choices = { "tuned", "lumped" }, default = "lumped",
        doc = "of the cells: tuned to dt so that waves keep their speed, or all at the nodes" },
      { "plain", type = "boolean", default = false, doc = "factorises every interface tangent, to verify those solved with another's factor" },
    },
  },
}

table.insert(words[9], {
  "explicit", makes = "solver",
  doc = "The classic explicit code: central differences with lumped mass and penalty contact, in as many equal substeps per `dt` as "
    .. "stability requires. A rival of LATIN and an independent check. Static steps are computed as by solver.monolithic.",
  arguments = {
    { "safety", type = "number", range = { 0.01, 2 }, default = 0.9, doc = "fraction of the critical substep; unstable above 1" },
    { "penalty", type = "number", range = { 1e-4, 100 }, default = 0.1,
      doc = "contact stiffness relative to the layer of elements behind it; plastic and releasable interfaces: at least 1" },
    { "integration", type = "choice", choices = { "one_point", "full" }, default = "one_point",
      doc = "of hexahedra; full: the elements of the other solvers" },
    { "hourglass", type = "number", range = { 0, 1 }, default = 0.1, doc = "stiffness against hourglass modes, one_point only" },
    { "bulk_viscosity", type = "boolean", default = true, doc = "linear 0.06, quadratic 1.2, against the ringing of fronts" },
  },
})

-- The arguments of a spectrum after those of its own.
local function spectrum(arguments, per_octave)
  for _, argument in ipairs{
    { "q_factor", type = "number", range = { 0.5, 1000 }, default_doc = "10", doc = "amplification at resonance, above 0.5" },
    { "damping", type = "number", range = { 0, 0.99 }, doc = "damping ratio, 1/(2 q_factor), instead" },
    { "quantity", type = "choice", default = "absolute_acceleration",
      choices = { "absolute_acceleration", "relative_displacement", "pseudo_velocity" }, doc = "response of the oscillator" },
    { "from", type = "number", unit = "Hz", range = { 0.01, 1e8 }, default = 100, doc = "first frequency" },
    { "to", type = "number", unit = "Hz", range = { 0.01, 1e8 }, default = 10000, doc = "highest frequency, the last one: from, from 2^(1/per_octave), ..., to" },
    { "per_octave", type = "integer", range = { 1, 1000 }, default = per_octave, doc = "frequencies per octave" },
    { "taper", type = "number", unit = "s", range = { 0, 1e4 }, default = 0,
      doc = "length of a half-cosine fade to zero at the end of the dynamic steps: avoids a velocity step at the end of the record" },
  } do
    table.insert(arguments, argument)
  end
  return arguments
end

local quantities = { "displacement", "velocity", "acceleration", "stress", "von_mises", "material_stress", "failure_index", "pressure" }
local fields = { "displacement", "velocity", "stress", "von_mises", "stress_error" }
local all_fields = { "displacement", "velocity", "stress", "von_mises", "stress_error", "material_stress", "failure_index" }

words[10] = {
  name = "output", doc = "Requested results: files in the output directory, and data for the deck (`result[output]`).",
  {
    "vtk", makes = "output", doc = "Frames for ParaView.",
    arguments = {
      { "frames", type = "integer", range = { 1, 100000 }, default = 50, doc = "frames per step" },
      { "fields", type = "choices", choices = all_fields, default = fields,
        doc = "fields of the parts; material_stress (along the axes of a material with directions: 11, 22, 33, 12, 23, 13) and failure_index are not a number in parts of other materials" },
    },
  },
  {
    "history", makes = "output",
    doc = "A quantity against time, as the mean over a face or a region. Columns: the quantity if it is one number or has a "
      .. "`direction`, else x, y, z (of stress xx, yy, zz, xy, yz, zx; of material_stress s11, s22, s33, s12, s23, s13).",
    arguments = {
      name_of "output",
      on({ "face", "region", "interface", "support" }, "where; `pressure` requires an interface or a wall"),
      { "quantity", type = "choice", choices = quantities, required = true, doc = "recorded quantity" },
      { "direction", in_frame = "direction", type = "vector", doc = "its component along this direction; its length does not matter" },
      frame "of `direction`",
      { "ply", type = "integer", range = { 1, 10000 }, default_doc = "of the failure index the worst", doc = "of a laminate, 1 the lowest: material_stress is that in its middle, failure_index the larger of both its faces" },
    },
  },
  {
    "resultant", makes = "output", doc = "The force through an interface or a support, of a list their sum (x, y, z: on the first part that each names). If two supports hold a node along one direction, the first listed gets its reaction. Columns: normal, shear, x, y, z (N).",
    arguments = { name_of "output", on({ "interface", "support" }, "what transmits the force") },
  },
  {
    "momentum", makes = "output",
    doc = "Linear momentum of parts: impulse and rebound without reading a velocity at a point. Columns: x, y, z (N s); over their mass, "
      .. "the velocity of their centre of gravity.",
    arguments = {
      name_of "output",
      { "of", type = "objects", kinds = { "substructure" }, at_least = 1, or_single = true, default_doc = "all", doc = "parts" },
    },
  },
  {
    "srs", makes = "output", of_motion = true, or_list = "list of spectra",
    doc = "Shock response spectrum of a history. Columns: frequency, maximax, positive, negative, primary, residual. With `on` those of a place along several directions: "
      .. "a list of outputs, whose spectra are called `name x`, `name y`, ... and answer by their directions, `list.x`, as their histories do, `list.histories.x`.",
    arguments = spectrum({
      name_of "output",
      { "of", type = "object", kinds = { "output.history" }, doc = "an acceleration with a direction" },
      { "on", type = "objects", kinds = { "face", "region" }, at_least = 1, or_single = true, doc = "instead of `of`: where the acceleration is taken" },
      { "directions", in_frame = "directions", type = "directions", with = "on", default_doc = "\"xyz\"",
        doc = "along which: some of the axes, or vectors by name, as { axial = { 0, 0, 1 } }" },
      frame "of `directions`: with \"xyz\", its axes",
      { "specification", by_direction = true, type = "specification", unit = "m/s^2", doc = "specification for the maximax in report.html: a CSV of frequency "
        .. "(Hz) and level (m/s^2; or units in brackets in its header, [g] or (g)), or { {100, 20*g0}, {1000, 500*g0} }; log-log in between; judged from 1/record length to half the sampling rate; with `on` one for all, or by directions, { axial = ... }" },
      { "margin", by_direction = true, type = "number", unit = "dB", range = { 0, 60 }, with = "specification", default_doc = "0",
        doc = "that the spectrum is to keep below its specification" },
      { "judge", type = "choice", choices = { "maximax", "primary" }, default = "maximax",
        doc = "the column compared with the specification, whose band is estimated; primary: the response during the record only" },
    }, 12),
    one_of = { "of", "on" },
  },
  {
    "srs_field", makes = "output", of_motion = true,
    doc = "Shock response spectra at every node of faces, for ParaView: <name>.pvd, whose time is the frequency (Hz). Columns of "
      .. "<name>.csv: frequency, highest and mean maximax over the nodes.",
    arguments = spectrum({
      name_of "output",
      on({ "face" }, "faces"),
      { "direction", in_frame = "direction", type = "vector", default_doc = "the axis of largest maximax, node by node",
        doc = "of the acceleration; its length does not matter" },
      frame "of `direction`",
    }, 3),
  },
  {
    "attenuation", makes = "output", of_motion = true,
    doc = "Shock attenuation across a joint: maximax spectra of the histories before and after it and their ratio by band. Columns: "
      .. "frequency, entering, leaving, ratio (dB); with _x, _y, _z for histories without a direction. `rule` is the handbooks' rule of thumb (dB): -13 per metre of `distance`, -3 per bolted joint (`joints`), -2 per bond (`bonds`), -20 per isolator (`isolators`).",
    arguments = spectrum({
      name_of "output",
      { "entering", type = "object", kinds = { "output.history" }, required = true, doc = "acceleration before the joint" },
      { "leaving", type = "object", kinds = { "output.history" }, required = true, doc = "acceleration after the joint" },
      { "bands", type = "integer", range = { 1, 24 }, default = 1, doc = "bands per octave: 1, or 3 for thirds" },
      { "joints", type = "integer", range = { 1, 100 }, default_doc = "those of the model",
        doc = "bolted joints on the path, for the rule of thumb of -3 dB each, in place of what the model has on its way" },
    }, 12),
  },
  {
    "joint", makes = "output",
    doc = "History of an interface: normal, shear (N), opening, slip, plastic_opening (m), open_area, stick_area, slip_area "
      .. "(m^2), friction_work, plastic_work, damping_work, stored_energy (J). `slip` is how far the two sides have moved on each other along the joint, from "
      .. "their first touch to their last, at the point where that is farthest: there and back again is none, what a point moves while it is open counts once it touches "
      .. "again, `friction_work` counts the way under pressure. `opening` is that "
      .. "of the point where its size is largest.",
    arguments = { name_of "output", on({ "interface", "support.wall" }, "interfaces or walls") },
  },
  {
    "footprint", makes = "output",
    doc = "Contact footprint of an interface. Columns: pressure (largest, Pa), area (in contact, m^2), x, y, z (centre of pressure, m), spread_x, spread_y, "
      .. "spread_z (root mean square distance of the normal force from there, m), shear_x, shear_y, shear_z (the same of the tangential force).",
    arguments = {
      name_of "output",
      on({ "interface", "support.wall" }, "interfaces or walls"),
      { "about", type = "vector", unit = "m", range = { -1000, 1000 }, default_doc = "the centre of pressure", doc = "origin of the distances; in a symmetric model, a point on the planes of symmetry" },
      { "direction", type = "vector", default_doc = "the modulus", doc = "of the tangential force; its length does not matter" },
    },
  },
  {
    "loop", makes = "output",
    doc = "A condensed joint: force against displacement along a direction, and data for a system model: cycles with their loss and "
      .. "stiffness, the exponent of the loss, and the curve of first loading with equivalent sliders. Columns: displacement (m), "
      .. "force (N).",
    arguments = {
      name_of "output",
      on({ "interface", "support" }, "what transmits the force: interfaces, or supports"),
      { "direction", type = "vector", required = true, doc = "along which; its length does not matter" },
      { "between", type = "objects", kinds = { "face", "region" }, at_least = 1, or_single = true,
        doc = "two places, on side 1 and on side 2: the displacement of the second relative to the first, including flexibility of the parts; one "
          .. "place: relative to the ground; left out: relative displacement of the joint's sides" },
      { "after", type = "object", kinds = { "step" }, doc = "the loading begins at the end of this step (the tightened joint); left out: at the start" },
      { "steps", type = "objects", kinds = { "step" }, at_least = 1, or_single = true, default_doc = "those after `after`, as long as they are of one kind",
        doc = "the consecutive steps in which it is loaded and its cycles are closed" },
    },
  },
  {
    "superelement", makes = "output",
    doc = "The assembly condensed about its tightened state: mass and stiffness on the motions of some faces and on modes (Craig and Bampton), "
      .. "as Matrix Market files, with a page that describes each row. Columns: frequency (Hz), damping (ratio) of its own modes.",
    arguments = {
      name_of "output",
      on({ "face", "region" }, "faces and regions that stay accessible: to attach, load or measure"),
      { "up_to", type = "number", unit = "Hz", range = { 0.01, 1e8 }, doc = "highest frequency of use: fixed-interface modes are kept up to twice that" },
      { "modes", type = "integer", range = { 1, 2000 }, doc = "number of modes to keep instead" },
      { "motion", type = "choice", choices = { "mean", "rigid", "nodes" }, default = "mean",
        doc = "rows of a face: its six mean motions, the face free to deform; its six motions as a rigid body; or three per node" },
      { "sliding", type = "choice", choices = { "tied", "free" }, default = "tied",
        doc = "contact points at their friction limit: tied, as after the first reversal, or free along their tangents" },
      { "format", type = "choice", choices = { "matrix_market", "dmig" }, default = "matrix_market",
        doc = "\"dmig\": `<name>.pch` for Nastran (GRID, SPOINT, DMIG), with `<name>_points.csv`, beside the others" },
      { "after", type = "object", kinds = { "step" }, default_doc = "the last static step", doc = "about the state at the end of this step, with its supports" },
    },
    one_of = { "up_to", "modes" },
  },
  {
    "modes", makes = "output",
    doc = "Natural modes of the assembly about the end of a static step: ties closed, contacts as they stand there, supports of that step; without a static "
      .. "step, of the unloaded assembly. Rigid-body modes and mechanisms come first, at 0 Hz. Shapes for ParaView: <name>.pvd, whose time is the frequency (Hz). Columns: frequency (Hz), number, damping (ratio), generalised_mass "
      .. "(kg, of the shape whose largest displacement is one), participation_x, _y, _z, _about_x, _about_y, _about_z (about the axes through the centre "
      .. "of mass, m), effective_x ... effective_about_z (effective masses, kg, kg m^2).",
    arguments = {
      name_of "output",
      { "n", type = "integer", range = { 1, 2000 }, default_doc = "10", doc = "number of modes, including those at 0 Hz" },
      { "up_to", type = "number", unit = "Hz", range = { 0.01, 1e8 }, doc = "or all up to this frequency" },
      { "sliding", type = "choice", choices = { "tied", "free" }, default = "tied",
        doc = "contact points at their friction limit: tied, as after the first reversal, or free along their tangents" },
      { "after", type = "object", kinds = { "step" }, default_doc = "the last static step", doc = "about the state at the end of this step, with its supports" },
    },
  },
  {
    "backbone", makes = "output",
    doc = "Frequency and damping of a mode against its amplitude, by quasi-static modal analysis: of static steps in which `load.mode` pushes the assembly, a row an increment of the first loading, friction and contact as they are. "
      .. "Damping is that of friction by Masing's rule and of the materials; `cycle_frequency` and `cycle_damping` those of a whole cycle, where the steps go on to the opposite load and back. Columns: acceleration, displacement (m/s^2, m, where the shape is largest), frequency (Hz), damping (ratio), material_damping (the materials' part of it).",
    arguments = {
      name_of "output",
      { "mode", type = "object", kinds = { "output.modes" }, required = true, doc = "the modes" },
      { "number", type = "integer", range = { 1, 2000 }, required = true, doc = "which of them" },
      { "steps", type = "objects", kinds = { "step" }, at_least = 1, or_single = true, required = true, doc = "the static steps with the load, in their order" },
    },
  },
  {
    "ringdown", makes = "output",
    doc = "Frequency and damping of a vibration that decays freely, against its amplitude: a band of the history in a dynamic step, seen through a window of 4.44 / (width of the band) that moves along it, "
      .. "a row a period until the amplitude is a thousandth of the first; the summary ends where what iterations leave begins to show. Columns: time (s), amplitude (of the history), frequency (Hz), damping (ratio).",
    arguments = {
      name_of "output",
      { "of", type = "object", kinds = { "output.history" }, required = true, doc = "the history: one column, as with a `direction`" },
      { "band", type = "numbers", unit = "Hz", range = { 1e-3, 1e8 }, at_least = 2, at_most = 2, doc = "lowest and highest frequency, which holds this vibration alone; at most a factor of three" },
      { "mode", type = "object", kinds = { "output.modes" }, with = "number", doc = "instead of `band`: modes, one of which rings; the band goes half of the way to the next ones" },
      { "number", type = "integer", range = { 1, 2000 }, with = "mode", doc = "which of them, as in their table" },
      { "step", type = "object", kinds = { "step" }, default_doc = "the last dynamic step", doc = "the dynamic step" },
      { "from", type = "number", unit = "s", range = { 0, 100 }, default = 0, doc = "when the free vibration begins, from the start of the step" },
    },
    one_of = { "band", "mode" },
  },
  {
    "energy", makes = "output",
    doc = "Energy balance of the assembly. Columns: kinetic, strain, loads, friction, plastic, damping, scheme, balance, stored (J; in interfaces).",
    arguments = {},
  },
}

words[11] = {
  name = "problem", doc = "What is computed. Only what a problem lists takes part.",
  call = {
    makes = "problem", doc = "An assembly, its steps and its outputs.",
    arguments = {
      name_of "problem",
      { "substructures", type = "objects", kinds = { "substructure" }, at_least = 1, required = true, doc = "parts" },
      { "interfaces", type = "objects", kinds = { "interface" }, default = {}, doc = "where parts meet" },
      { "supports", type = "objects", kinds = { "support" }, default = {}, doc = "what holds them" },
      { "steps", type = "objects", kinds = { "step" }, at_least = 1, required = true, doc = "in order" },
      { "solver", type = "object", kinds = { "solver" }, default_doc = "solver.latin{}", doc = "solution method" },
      { "outputs", type = "objects", kinds = { "output" }, default = {}, doc = "requested results" },
    },
  },
}

words[12] = {
  name = "ensemble", doc = "One problem many times, with parameters that scatter from unit to unit.",
  call = {
    makes = "ensemble", doc = "Members whose parameters are drawn from distributions. They differ in numbers of laws, loads, gaps and velocities alone.",
    arguments = {
      { "n", type = "integer", range = { 2, 100000 }, default_doc = "required; of \"corners\" 2^parameters", doc = "number of members" },
      { "seed", type = "integer", range = { 0, 1e9 }, default = 1, doc = "of the draw: the same seed gives the same members" },
      { "method", type = "choice", choices = { "latin hypercube", "random", "sobol", "corners" }, default = "latin hypercube",
        doc = "how values are spread: each of n equal strata of every parameter once; independently; a sequence that fills evenly; or all combinations of the "
          .. "bounds, without P95/50 (of normal and lognormal ones the quantiles 2.5 % and 97.5 %)" },
      { "vary", type = "distributions", required = true, doc = "the parameters: a distribution, a list of equally likely numbers, or { distribution, "
        .. "each = bolts }, which draws a value for each item of the list" },
      { "of", type = "function", required = true, signature = "fun(v: table): dygita.problem", doc = "function(v) that returns the problem with the parameters v.name (with `each` a list)" },
    },
  },
}

-- Called with plain numbers.
local distributions = {
  { "uniform", write = "uniform(low, high)", doc = "Every value between two bounds is equally likely.",
    arguments = { { "low", doc = "lowest value" }, { "high", doc = "highest value" } } },
  { "normal", write = "normal(mean, deviation)", doc = "The normal distribution.",
    arguments = { { "mean", doc = "mean" }, { "deviation", doc = "standard deviation" } } },
  { "lognormal", write = "lognormal(median, deviation)", doc = "The logarithm is normal: factors of the median, never below zero.",
    arguments = { { "median", doc = "median" }, { "deviation", doc = "standard deviation of the natural logarithm: 0.25 is about 25 %" } } },
  { "triangular", write = "triangular(low, likeliest, high)", doc = "Rises from the lowest value to the likeliest, falls to the highest.",
    arguments = { { "low", doc = "lowest value" }, { "likeliest", doc = "likeliest value" }, { "high", doc = "highest value" } } },
}

local methods = {
  {
    kind = "mesh file", "volume", write = "file:volume \"name\"", makes = "mesh",
    doc = "One volume of the file by the name of its physical group.",
    argument = { "name", type = "text", doc = "the volume's name" },
  },
  {
    kind = "assembly", "part", write = "assembly:part \"name\"", makes = "mesh",
    doc = "One part of a CAD assembly: by its name, its product or its instance, if that is unique.",
    argument = { "name", type = "text", doc = "the part's name" },
  },
  {
    kind = "assembly", "parts", write = "assembly:parts \"bolt*\"", makes = "mesh", is_list = true,
    doc = "The list of all parts whose name, product or instance fits, in the order of the file; * stands for any text. `mesh.name` is the part's name.",
    argument = { "pattern", type = "text", doc = "a name, or a pattern with *" },
  },
  {
    kind = "model file", "part", write = "file:part \"name\"", makes = "mesh",
    doc = "One part of a file of another program, by its name: the instance's, else that of the section's element set, `name[1]` ... where its cells form several unconnected pieces.",
    argument = { "name", type = "text", doc = "the part's name" },
  },
  {
    kind = "model file", "parts", write = "file:parts \"BOLT*\"", makes = "mesh", is_list = true,
    doc = "The list of all parts whose name, element set or instance fits, in the order of the file; * stands for any text.",
    argument = { "pattern", type = "text", doc = "a name, or a pattern with *" },
  },
  {
    kind = "model file", "material", write = "file:material \"name\"", makes = "material",
    doc = "A material of the file, turned into SI by its `units`: isotropic, or with three planes of symmetry.",
    argument = { "name", type = "text", doc = "the material's name" },
    arguments = {
      { "name", type = "text", required = true, doc = "the material's name, in `file:material{ name = \"EL\", density = 7850 }`" },
      { "density", type = "number", unit = "kg/m^3", range = { 10, 100000 }, default_doc = "the file's", doc = "mass per volume" },
      { "yield", type = "number", unit = "Pa", range = { 1e5, 1e11 }, doc = "yield stress that the run monitors, of an isotropic material" },
      strength, criterion,
      damping_time, damping_ratio, damping_frequency, damping_band,
    },
  },
  {
    kind = "model file", "report", write = "file:report()", answers = "text",
    doc = "Text: what of the file is read as something else, and each keyword that is not used, with its lines.",
  },
  {
    kind = "mesh", "cut", write = "mesh:cut{ normal = { 0, 0, 1 }, at = 18*mm }", makes = "mesh", is_list = true,
    doc = "The list of the two halves of a mesh, behind a plane and beyond it, each with the new face `cut`: a bolt in one solid is two substructures then, and the interface between their faces is tightened. "
      .. "Tetrahedra are divided, so that both faces lie in the plane and match; cells of other kinds stay whole, and the cut is the plane of their facets that is nearest.",
    argument = { "surface", type = "text", doc = "of a file of another program instead: a surface inside the part, as `*PRE-TENSION SECTION` has it; the first half has the cells that the surface names" },
    arguments = {
      { "normal", type = "vector", with = "at", doc = "of the plane, in the coordinates of the mesh; its length does not matter" },
      { "at", type = "number", unit = "m", range = { -1000, 1000 }, with = "normal", doc = "where along the normal" },
      { "surface", type = "text", doc = "instead of them" },
      { "face", type = "name", default = "cut", doc = "name of the new face" },
    },
    one_of = { "normal", "surface" },
  },
  {
    kind = "substructure", "region", write = "part:region \"set\"", makes = "region",
    doc = "The nodes of a named set of the file from which the part's mesh comes.",
    argument = { "set", type = "text", doc = "the set's name" },
  },
  {
    kind = "substructure", "face", write = "part:face \"group\"", makes = "face", tells_frame = true,
    doc = "A named group of facets: xmin ... zmax of a box; of a file the surface group `part.group`, or `group` on the "
      .. "part's boundary.",
    argument = { "group", type = "text", doc = "the group's name" },
    arguments = {
      frame "of the places and directions",
      { "normal", in_frame = "direction", type = "vector", doc = "instead of a name, `part:face{ normal = { 0, 0, 1 }, at = 18*mm }`: facets whose outward normal is "
        .. "this, within two degrees" },
      { "at", in_frame = "height", type = "number", unit = "m", range = { -1000, 1000 }, doc = "where along the normal: all nodes of the facet lie in that plane" },
      { "cylinder", type = "boolean", default = false, doc = "facets on a cylinder" },
      { "radius", type = "number", unit = "m", range = { 1e-6, 1000 }, doc = "of the cylinder, within two per cent" },
      { "axis", in_frame = "direction", type = "vector", doc = "of the cylinder, within two degrees" },
      { "low", in_frame = "corner", type = "vector", unit = "m", range = { -1000, 1000 }, doc = "lowest corner of a box that the facets lie in; with `high`" },
      { "high", in_frame = "corner", type = "vector", unit = "m", range = { -1000, 1000 }, doc = "highest corner of the box" },
      { "where", in_frame = "function", type = "function", doc = "function(x, y, z), in metres, true at every node of the facets" },
    },
  },
  {
    kind = "substructure", "where", write = "part:where(function(x, y, z) return boolean end)", makes = "region", unwraps = "where", tells_frame = true,
    doc = "The nodes at which the function returns true; near(a, b) compares coordinates with a tolerance.",
    argument = { "function", type = "function", doc = "function(x, y, z), in metres" },
    arguments = {
      { "where", in_frame = "function", type = "function", required = true, doc = "the function, in `part:where{ frame = f, where = function(x, y, z) ... end }`" },
      frame "of x, y and z",
    },
  },
  {
    kind = "history", "shifted", write = "signal:shifted(t)", makes = "history",
    doc = "Delayed by t; before t it has the value that it had before 0.",
    argument = { "t", type = "number", unit = "s", range = { -100, 100 }, doc = "how much later; negative: earlier" },
  },
  {
    kind = "history", "scaled", write = "signal:scaled(t)", makes = "history",
    doc = "Stretched in time, t times as long: `signal:scaled(1e-3)` for a file in milliseconds without a unit. Its values are scaled by "
      .. "`2*signal`.",
    argument = { "t", type = "number", range = { 1e-12, 1e12 }, doc = "times as long" },
  },
  {
    kind = "problem", "run", write = "problem:run{}", makes = "result",
    doc = "Computes, writes out/<problem>/<case>/ and returns the result.",
    arguments = {
      { "case", type = "name", default = "base", doc = "name of this case, for its folder" },
      { "start_from", type = "object", kinds = { "result" }, doc = "result of an earlier case: the iteration of each "
        .. "increment starts from its interface fields; the answer is the same within the tolerance" },
      { "at", type = "settings", doc = "parameters of this case by name, SI, as { mu = 0.3 }: with several cases of a problem "
        .. "out/<problem>/study.csv and study.svg show the results" },
      { "check_cold", type = "boolean", default = false, doc = "runs the case again without `start_from`, and reports its "
        .. "iterations and the difference of the answers" },
    },
  },
  {
    kind = "ensemble", "run", write = "ensemble:run{}", makes = "ensemble result",
    doc = "Computes all members, writes out/<problem>/<case>/ and returns their statistics.",
    arguments = {
      { "case", type = "name", default = "ensemble", doc = "name for its folder; members are `case_1`, `case_2`, ..." },
      { "members", type = "boolean", default = false, doc = "writes the folder of each member, too" },
    },
  },
  {
    kind = "sample", "quantile", write = "sample:quantile(0.05)", answers = "number",
    doc = "The value that this share of the members stays below, linear between them.",
    argument = { "share", type = "number", range = { 0, 1 }, required = true, doc = "from 0 to 1" },
  },
}

local reading = {
  { "result[output]", "the data of an output: its columns by their names" },
  { "result[output].normal", "one column, a series" },
  { "series.max, .min, .first, .last", "its largest, smallest, first and last value" },
  { "series[i], #series", "row i, from 1; the number of rows" },
  { "series:at(t)", "the value at a time (s), linear between rows" },
  { "series:at(step)", "the value in the last row of a step" },
  { "series.time", "its times, a series (.frequency for a spectrum)" },
  { "result[loop].cycles, .backbone", "its tables: their columns by their names, as `result[loop].cycles.loss`" },
  { "result[loop].exponent", "exponent of the loss against the force amplitude; also .displacement_exponent, .stiffness, .secant, .not_converged (increments)" },
  { "result[history].max", "a history with one column answers as that series; of x, y, z `.max` is the largest modulus" },
  { "result.iterations", "iterations of all steps, a whole number" },
  { "result.mean_iterations", "iterations per increment" },
  { "result.converged", "whether every increment converged" },
  { "ensemble[output].p95_50, .median, .lowest, .highest, .spread", "of an ensemble's result: series of a spectrum (its first column; others as `ensemble[output].primary.p95_50`); p95_50: the level that 95 % of the units stay below with 50 % confidence; spread: standard deviation in dB" },
  { "ensemble[output].normal.median, .lowest, .highest", "the same of a column of another output, row by row" },
  { "ensemble[output].normal.last, .first, .max, .min", "a sample: one number a member; .median, .mean, .deviation, .min, .max, [i], #, :quantile(share)" },
  { "ensemble.drives[output]", "what drives its figures: a list of { figure, parameter, correlation, low, high, share, clear }, the strongest first, `clear` where the bounds low and high exclude zero (else it is not distinguishable from none); prints as text; of a spectrum `.mu:at(f)` is the rank correlation with parameter mu" },
  { "ensemble[i], #ensemble", "the result of member i; the number of members" },
  { "ensemble.converged", "whether all members converged: statistics leave out those that did not" },
}

for _, name in ipairs { "mass", "frame", "pattern", "bolt", "field" } do words[#words + 1], words[name] = words[name], nil end

-- Fields that a deck can read of bolts, frames and lists.
local fields = {
  bolt = {
    { "name", kind = "text", doc = "its name" },
    { "parts", kind = "substructure", is_list = true, doc = "head, nut and washers: for `substructures`" },
    { "interfaces", kind = "interface", is_list = true, doc = "the shank's and, with washers, theirs against head and nut: for `interfaces`" },
    { "shank", kind = "interface", doc = "across the middle of the shank: for load.preload and load.shortening" },
    { "upper", kind = "face", doc = "bears on the upper clamped face: the washer's lower face, or the head's" },
    { "lower", kind = "face", doc = "bears on the lower clamped face" },
    { "head", kind = "substructure", doc = "the head with half of the shank" },
    { "nut", kind = "substructure", doc = "the nut with the other half" },
    { "washers", kind = "substructure", is_list = true, doc = "under the head, under the nut" },
    { "top", kind = "face", doc = "the free face of the head" },
    { "tip", kind = "face", doc = "the free face of the nut, with the end of the shank" },
    { "diameter", kind = "number", doc = "of the shank (m)" },
    { "grip", kind = "number", doc = "clamped thickness, without the washers (m)" },
    { "area", kind = "number", doc = "of the shank's section (m^2)" },
  },
  frame = {
    { "x", kind = "vector", doc = "its x axis, in the axes of the deck" },
    { "y", kind = "vector", doc = "its y axis" },
    { "z", kind = "vector", doc = "its z axis" },
    { "origin", kind = "vector", doc = "its origin (m)" },
  },
  ["list of spectra"] = {
    { "histories", kind = "table", doc = "the histories, by direction" },
    { "[string]", kind = "output", doc = "the spectrum along a direction, by its name" },
  },
  ["list of bolts"] = {
    { "parts", kind = "substructure", is_list = true, doc = "those of all bolts of a pattern; `bolts[1]` is one bolt" },
    { "interfaces", kind = "interface", is_list = true, doc = "those of all" },
    { "shanks", kind = "interface", is_list = true, doc = "the shank of each" },
  },
}
return { words = words, methods = methods, reading = reading, fields = fields, distributions = distributions }
