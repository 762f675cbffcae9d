local m = material.elastc{ name = "steel" }
