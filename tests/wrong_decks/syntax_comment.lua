// a comment
local n = 3
