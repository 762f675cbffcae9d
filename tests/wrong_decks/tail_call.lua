local function block(size)
  local cells = 2
  return mesh.box{ size = { size, size, size }, cells = { cells, cells, 0 } }
end
local m = block(10*mm)
