local wave = function(t) return sin(t) end
local x = sin(3)
