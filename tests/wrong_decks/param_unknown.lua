local p = param{ friction = 0.3, n = 4 }
local mu = p.frction
