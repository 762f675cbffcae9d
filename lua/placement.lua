-- Where a part stands: a rotation and a translation, x' = R x + t, as twelve numbers (R row by row, then t).
local placement = {}

-- About a line through `about` along `axis` (any length), by `angle` in radians; nothing where the axis is zero.
function placement.rotation(axis, angle, about)
  local length = math.sqrt(axis[1] ^ 2 + axis[2] ^ 2 + axis[3] ^ 2)
  if length == 0 then return nil end
  local x, y, z = axis[1] / length, axis[2] / length, axis[3] / length
  local c, s = math.cos(angle), math.sin(angle)
  local d = 1 - c
  local p = {
    c + x * x * d, x * y * d - z * s, x * z * d + y * s,
    y * x * d + z * s, c + y * y * d, y * z * d - x * s,
    z * x * d - y * s, z * y * d + x * s, c + z * z * d,
  }
  for i = 1, 3 do
    p[9 + i] = about[i] - (p[3 * i - 2] * about[1] + p[3 * i - 1] * about[2] + p[3 * i] * about[3])
  end
  return p
end

function placement.translation(by) return { 1, 0, 0, 0, 1, 0, 0, 0, 1, by[1], by[2], by[3] } end

-- What a substructure's `place` holds, as twelve numbers.
function placement.of(place) return #place == 12 and place or placement.translation(place) end

-- First `inner`, then `outer`.
function placement.after(outer, inner)
  local p = {}
  for i = 1, 3 do
    for j = 1, 3 do
      p[3 * i - 3 + j] = outer[3 * i - 2] * inner[j] + outer[3 * i - 1] * inner[3 + j] + outer[3 * i] * inner[6 + j]
    end
    p[9 + i] = outer[3 * i - 2] * inner[10] + outer[3 * i - 1] * inner[11] + outer[3 * i] * inner[12] + outer[9 + i]
  end
  return p
end

-- Three numbers where nothing turns, else all twelve.
function placement.shortest(p)
  for i = 1, 9 do
    local identity = (i == 1 or i == 5 or i == 9) and 1 or 0
    if math.abs(p[i] - identity) > 1e-15 then return p end
  end
  return { p[10], p[11], p[12] }
end

return placement
