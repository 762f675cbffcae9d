local a = history.ramp{ to = 1, duration = 1*ms }
local c = a^2
