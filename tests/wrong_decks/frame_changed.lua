local f = frame{ origin = { 1*mm, 0, 0 } }
print(#f.origin, f.origin[1], table.unpack(f.x))
for i, x in ipairs(f.y) do assert(x == f.y[i]) end
f.origin[1] = 5*mm
