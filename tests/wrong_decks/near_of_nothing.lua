local p = param{ mu = 0.3 }
local same = near(1*mm, nil)
