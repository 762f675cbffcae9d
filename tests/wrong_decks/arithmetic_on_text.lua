local length = "10 mm"
local area = length * {}
