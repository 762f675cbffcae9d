-- Masses on faces: a rigid body, and the bond between each of its faces and the one that it is on. A problem that lists
-- the mass has its bonds.
local native = ...
local interfaces = native.module "interfaces"
local masses = {}

local bonds_of = setmetatable({}, { __mode = "k" })  -- by the mass

function masses.declare(entry, given, line)
  local body = native.make(entry.path, "substructure", given, line)
  interfaces.note_part(body)
  local bonds = {}
  for i, face in ipairs(given.on) do
    local own = native.call("substructure:face", body, ("face %d"):format(i), line)
    bonds[i] = native.make("interface.bonded", "interface", {
      name = ("%s/%s"):format(given.name, select(3, native.kind(face))), between = { face, own },
      motion = given.motion == "mean" and "mean" or "points", weights = given.weights }, line)
    interfaces.note(bonds[i])
  end
  bonds_of[body], given.joints = bonds, bonds
  return body
end

-- Adds to the interfaces of a problem those of the masses among its parts.
function masses.join(given)
  local all = {}
  for _, interface in ipairs(given.interfaces or {}) do all[#all + 1] = interface end
  for _, part in ipairs(given.substructures) do
    for _, bond in ipairs(bonds_of[part] or {}) do all[#all + 1] = bond end
  end
  given.interfaces = all
end

return masses
