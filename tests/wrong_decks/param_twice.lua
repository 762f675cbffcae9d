local p = param{ mu = 0.3 }
local q = param{ n = 4 }
