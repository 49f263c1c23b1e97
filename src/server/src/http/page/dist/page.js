var Fh={form:{},looks:{},cameras:[],grips:[]},Bh=i=>`unwrapd.${i}`;function or(i){try{return JSON.parse(localStorage.getItem(Bh(i))??"null")??Fh[i]}catch{return Fh[i]}}function so(i,e){try{localStorage.setItem(Bh(i),JSON.stringify(e))}catch{}}function ep(){for(let i of Object.keys(Fh))localStorage.removeItem(Bh(i))}var ro=80,kh=[8,16,32,64,128],Kt={job:null,tab:"view",shade:"charts",measure:"sym-dirichlet",scale:"fixed",seams:!0,wire:!1,problems:!0,only:!1,cells:32,set:null,uvs:"after",atlas:null,aim:"chart",face:null,chart:null,seam:null,alone:null,split:50,camera:null,plane:null};function zh(){let i=new URLSearchParams(location.hash.slice(1)),e=i.size?{...Kt}:{...Kt,...or("looks")};for(let[t,n]of i)t in Kt&&(t==="camera"||t==="plane"?e[t]=ex(n,t==="camera"?6:3):t==="cells"?e[t]=kh.find(s=>String(s)===n)??Kt.cells:t==="split"?e[t]=Math.min(Math.max(Number.parseInt(n,10)||Kt.split,100-ro),ro):t==="alone"?e[t]=n==="solid"||n==="plane"?n:null:["face","chart","seam","set"].includes(t)?e[t]=/^\d+$/.test(n)?Number(n):null:typeof Kt[t]=="boolean"?e[t]=n==="1":e[t]=n);return e}function ex(i,e){let t=i.split(",").map(Number);return t.length===e&&t.every(Number.isFinite)?t:null}function Vh(i){let e=new URLSearchParams;for(let[t,n]of Object.entries(i))n===null||n===Kt[t]||(typeof n=="boolean"?e.set(t,n?"1":"0"):Array.isArray(n)?e.set(t,n.map(s=>Number(s.toPrecision(5))).join(",")):e.set(t,String(n)));return e.toString().replaceAll("%2C",",")}function tp(i,e=!1){let t=Vh(i);t!==location.hash.slice(1)&&history[e?"pushState":"replaceState"](null,"",`${location.pathname}${location.search}${t?`#${t}`:""}`)}var np=null,tx=0;function oo(i){np??=new Worker(new URL("worker.js?v=e60c84d781c864bd",import.meta.url),{type:"module"});let e=++tx,t=np;return new Promise((n,s)=>{let r=({data:o})=>{o.id===e&&(t.removeEventListener("message",r),o.analysis?n(o.analysis):s(new Error(`The analysis failed: ${o.error}`)))};t.addEventListener("message",r),t.postMessage({id:e,soup:i})})}var ms={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},gs={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Xp=0,Au=1,qp=2;var Ho=1,$p=2,Fr=3,vi=0,jt=1,Lt=2,ci=0,ys=1,Tu=2,Eu=3,Ru=4,Yp=5;var Xs=100,Kp=101,jp=102,Jp=103,Zp=104,Qp=200,em=201,tm=202,nm=203,Cu=204,Pu=205,im=206,sm=207,rm=208,om=209,am=210,lm=211,cm=212,hm=213,um=214,Ja=0,Za=1,Qa=2,Mr=3,el=4,tl=5,nl=6,il=7,Go=0,dm=1,fm=2,_i=0,Iu=1,Lu=2,Nu=3,Du=4,Uu=5,Ou=6,Wo=7,du="attached",pm="detached",Fu=300,qs=301,Br=302,_l=303,bl=304,$n=1e3,Xn=1001,Sr=1002,Mt=1003,Ml=1004;var $s=1005;var Ot=1006,kr=1007;var Kn=1008;var Rn=1009,Bu=1010,ku=1011,zr=1012,Sl=1013,Cn=1014,Jt=1015,hi=1016,wl=1017,Al=1018,Ys=1020,zu=35902,Vu=35899,Hu=1021,Gu=1022,an=1023,Ui=1026,qi=1027,Tl=1028,El=1029,xs=1030,Rl=1031;var Vr=1033,Xo=33776,qo=33777,$o=33778,Yo=33779,Cl=35840,Pl=35841,Il=35842,Ll=35843,Nl=36196,Dl=37492,Ul=37496,Ol=37488,Fl=37489,Ko=37490,Bl=37491,kl=37808,zl=37809,Vl=37810,Hl=37811,Gl=37812,Wl=37813,Xl=37814,ql=37815,$l=37816,Yl=37817,Kl=37818,jl=37819,Jl=37820,Zl=37821,Ql=36492,ec=36494,tc=36495,nc=36283,ic=36284,jo=36285,sc=36286;var Ds=2300,Us=2301,Ka=2302,fu=2303,pu=2400,mu=2401,gu=2402,mm=2500;var Wu=0,Jo=1,Hr=2,gm=3200;var Gr=0,ym=1,$i="",dt="srgb",pn="srgb-linear",vo="linear",lt="srgb";var ja=7680;var xm=519,vm=512,_m=513,bm=514,Xu=515,Mm=516,Sm=517,qu=518,$u=519,Yu=35044,Ku=35048;var Ks="300 es",qn=2e3,wr=2001;function nx(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function ix(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Ar(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function wm(){let i=Ar("canvas");return i.style.display="block",i}var ip={},Tr=null;function _o(...i){let e="THREE."+i.shift();Tr?Tr("log",e,...i):console.log(e,...i)}function Am(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Re(...i){i=Am(i);let e="THREE."+i.shift();if(Tr)Tr("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function De(...i){i=Am(i);let e="THREE."+i.shift();if(Tr)Tr("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function Ns(...i){let e=i.join(" ");e in ip||(ip[e]=!0,Re(...i))}function Tm(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var Em={[Ja]:Ja,[Qa]:nl,[el]:el,[Mr]:tl,[Za]:Za,[nl]:Qa,[il]:il,[tl]:Mr},oi=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},tn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],sp=1234567,yo=Math.PI/180,Os=180/Math.PI;function bi(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(tn[i&255]+tn[i>>8&255]+tn[i>>16&255]+tn[i>>24&255]+"-"+tn[e&255]+tn[e>>8&255]+"-"+tn[e>>16&15|64]+tn[e>>24&255]+"-"+tn[t&63|128]+tn[t>>8&255]+"-"+tn[t>>16&255]+tn[t>>24&255]+tn[n&255]+tn[n>>8&255]+tn[n>>16&255]+tn[n>>24&255]).toLowerCase()}function Ye(i,e,t){return Math.max(e,Math.min(t,i))}function ju(i,e){return(i%e+e)%e}function sx(i,e,t,n,s){return n+(i-e)*(s-n)/(t-e)}function rx(i,e,t){return i!==e?(t-i)/(e-i):0}function xo(i,e,t){return(1-t)*i+t*e}function ox(i,e,t,n){return xo(i,e,1-Math.exp(-t*n))}function ax(i,e=1){return e-Math.abs(ju(i,e*2)-e)}function lx(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*(3-2*i))}function cx(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*i*(i*(i*6-15)+10))}function hx(i,e){return i+Math.floor(Math.random()*(e-i+1))}function ux(i,e){return i+Math.random()*(e-i)}function dx(i){return i*(.5-Math.random())}function fx(i){i!==void 0&&(sp=i);let e=sp+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function px(i){return i*yo}function mx(i){return i*Os}function gx(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function yx(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function Ju(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function xx(i,e,t,n,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+n)/2),h=o((e+n)/2),u=r((e-n)/2),d=o((e-n)/2),f=r((n-e)/2),y=o((n-e)/2);switch(s){case"XYX":i.set(a*h,l*u,l*d,a*c);break;case"YZY":i.set(l*d,a*h,l*u,a*c);break;case"ZXZ":i.set(l*u,l*d,a*h,a*c);break;case"XZX":i.set(a*h,l*y,l*f,a*c);break;case"YXY":i.set(l*f,a*h,l*y,a*c);break;case"ZYZ":i.set(l*y,l*f,a*h,a*c);break;default:Re("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function rc(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Zu(i,e){if(e.constructor===Float32Array)return i;let t=rc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function Qu(i,e){if(e.constructor===Float32Array)return i;let t=rc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var Wr={DEG2RAD:yo,RAD2DEG:Os,generateUUID:bi,clamp:Ye,euclideanModulo:ju,mapLinear:sx,inverseLerp:rx,lerp:xo,damp:ox,pingpong:ax,smoothstep:lx,smootherstep:cx,randInt:hx,randFloat:ux,randFloatSpread:dx,seededRandom:fx,degToRad:px,radToDeg:mx,isPowerOfTwo:gx,ceilPowerOfTwo:yx,floorPowerOfTwo:Ju,setQuaternionFromProperEuler:xx,normalize:Qu,denormalize:Zu},Ee=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=Ye(this.x,e.x,t.x),this.y=Ye(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=Ye(this.x,e,t),this.y=Ye(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Ye(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(Ye(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},sn=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],y=r[o+2],x=r[o+3];if(u!==x||l!==d||c!==f||h!==y){let m=l*d+c*f+h*y+u*x;m<0&&(d=-d,f=-f,y=-y,x=-x,m=-m);let g=1-a;if(m<.9995){let S=Math.acos(m),M=Math.sin(S);g=Math.sin(g*S)/M,a=Math.sin(a*S)/M,l=l*g+d*a,c=c*g+f*a,h=h*g+y*a,u=u*g+x*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+y*a,u=u*g+x*a;let S=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=S,c*=S,h*=S,u*=S}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],y=r[o+3];return e[t]=a*y+h*u+l*f-c*d,e[t+1]=l*y+h*d+c*u-a*f,e[t+2]=c*y+h*f+a*d-l*u,e[t+3]=h*y-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),y=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*y,this._y=c*f*u-d*h*y,this._z=c*h*y+d*f*u,this._w=c*h*u-d*f*y;break;case"YXZ":this._x=d*h*u+c*f*y,this._y=c*f*u-d*h*y,this._z=c*h*y-d*f*u,this._w=c*h*u+d*f*y;break;case"ZXY":this._x=d*h*u-c*f*y,this._y=c*f*u+d*h*y,this._z=c*h*y+d*f*u,this._w=c*h*u-d*f*y;break;case"ZYX":this._x=d*h*u-c*f*y,this._y=c*f*u+d*h*y,this._z=c*h*y-d*f*u,this._w=c*h*u+d*f*y;break;case"YZX":this._x=d*h*u+c*f*y,this._y=c*f*u+d*h*y,this._z=c*h*y-d*f*u,this._w=c*h*u-d*f*y;break;case"XZY":this._x=d*h*u-c*f*y,this._y=c*f*u-d*h*y,this._z=c*h*y+d*f*u,this._w=c*h*u+d*f*y;break;default:Re("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(Ye(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},U=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(rp.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(rp.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),h=2*(a*t-r*s),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=Ye(this.x,e.x,t.x),this.y=Ye(this.y,e.y,t.y),this.z=Ye(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=Ye(this.x,e,t),this.y=Ye(this.y,e,t),this.z=Ye(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Ye(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Hh.copy(this).projectOnVector(e),this.sub(Hh)}reflect(e){return this.sub(Hh.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(Ye(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Hh=new U,rp=new sn,Ue=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],y=n[8],x=s[0],m=s[3],g=s[6],S=s[1],M=s[4],_=s[7],T=s[2],w=s[5],p=s[8];return r[0]=o*x+a*S+l*T,r[3]=o*m+a*M+l*w,r[6]=o*g+a*_+l*p,r[1]=c*x+h*S+u*T,r[4]=c*m+h*M+u*w,r[7]=c*g+h*_+u*p,r[2]=d*x+f*S+y*T,r[5]=d*m+f*M+y*w,r[8]=d*g+f*_+y*p,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,y=t*u+n*d+s*f;if(y===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/y;return e[0]=u*x,e[1]=(s*c-h*n)*x,e[2]=(a*n-s*o)*x,e[3]=d*x,e[4]=(h*t-s*l)*x,e[5]=(s*r-a*t)*x,e[6]=f*x,e[7]=(n*l-c*t)*x,e[8]=(o*t-n*r)*x,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Ns("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Gh.makeScale(e,t)),this}rotate(e){return Ns("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Gh.makeRotation(-e)),this}translate(e,t){return Ns("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Gh.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Gh=new Ue,op=new Ue().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),ap=new Ue().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function vx(){let i={enabled:!0,workingColorSpace:pn,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===lt&&(s.r=Di(s.r),s.g=Di(s.g),s.b=Di(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===lt&&(s.r=br(s.r),s.g=br(s.g),s.b=br(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===$i?vo:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[pn]:{primaries:e,whitePoint:n,transfer:vo,toXYZ:op,fromXYZ:ap,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:dt},outputColorSpaceConfig:{drawingBufferColorSpace:dt}},[dt]:{primaries:e,whitePoint:n,transfer:lt,toXYZ:op,fromXYZ:ap,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:dt}}}),i}var $e=vx();function Di(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function br(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var ar,sl=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{ar===void 0&&(ar=Ar("canvas")),ar.width=e.width,ar.height=e.height;let s=ar.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=ar}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Ar("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Di(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(Di(t[n]/255)*255):t[n]=Di(t[n]);return{data:t,width:e.width,height:e.height}}else return Re("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},_x=0,Er=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:_x++}),this.uuid=bi(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Wh(s[o].image)):r.push(Wh(s[o]))}else r=Wh(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function Wh(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?sl.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Re("Texture: Unable to serialize Texture."),{})}var bx=0,Xh=new U,Ft=class i extends oi{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=Xn,s=Xn,r=Ot,o=Kn,a=an,l=Rn,c=i.DEFAULT_ANISOTROPY,h=$i){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:bx++}),this.uuid=bi(),this.name="",this.source=new Er(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Ee(0,0),this.repeat=new Ee(1,1),this.center=new Ee(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ue,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Xh).x}get height(){return this.source.getSize(Xh).y}get depth(){return this.source.getSize(Xh).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){Re(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Re(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Fu)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case $n:e.x=e.x-Math.floor(e.x);break;case Xn:e.x=e.x<0?0:1;break;case Sr:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case $n:e.y=e.y-Math.floor(e.y);break;case Xn:e.y=e.y<0?0:1;break;case Sr:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};Ft.DEFAULT_IMAGE=null;Ft.DEFAULT_MAPPING=Fu;Ft.DEFAULT_ANISOTROPY=1;var it=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],y=l[9],x=l[2],m=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-x)<.01&&Math.abs(y-m)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+x)<.1&&Math.abs(y+m)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let M=(c+1)/2,_=(f+1)/2,T=(g+1)/2,w=(h+d)/4,p=(u+x)/4,v=(y+m)/4;return M>_&&M>T?M<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(M),s=w/n,r=p/n):_>T?_<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(_),n=w/s,r=v/s):T<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(T),n=p/r,s=v/r),this.set(n,s,r,t),this}let S=Math.sqrt((m-y)*(m-y)+(u-x)*(u-x)+(d-h)*(d-h));return Math.abs(S)<.001&&(S=1),this.x=(m-y)/S,this.y=(u-x)/S,this.z=(d-h)/S,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=Ye(this.x,e.x,t.x),this.y=Ye(this.y,e.y,t.y),this.z=Ye(this.z,e.z,t.z),this.w=Ye(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=Ye(this.x,e,t),this.y=Ye(this.y,e,t),this.z=Ye(this.z,e,t),this.w=Ye(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Ye(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},rl=class extends oi{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Ot,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new it(0,0,e,t),this.scissorTest=!1,this.viewport=new it(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Ft({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:Ot,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Er(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},mn=class extends rl{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},bo=class extends Ft{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Mt,this.minFilter=Mt,this.wrapR=Xn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var ol=class extends Ft{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Mt,this.minFilter=Mt,this.wrapR=Xn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var ke=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,r,o,a,l,c,h,u,d,f,y,x,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,h,u,d,f,y,x,m)}set(e,t,n,s,r,o,a,l,c,h,u,d,f,y,x,m){let g=this.elements;return g[0]=e,g[4]=t,g[8]=n,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=y,g[11]=x,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/lr.setFromMatrixColumn(e,0).length(),r=1/lr.setFromMatrixColumn(e,1).length(),o=1/lr.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,y=a*h,x=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+y*c,t[5]=d-x*c,t[9]=-a*l,t[2]=x-d*c,t[6]=y+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,y=c*h,x=c*u;t[0]=d+x*a,t[4]=y*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-y,t[6]=x+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,y=c*h,x=c*u;t[0]=d-x*a,t[4]=-o*u,t[8]=y+f*a,t[1]=f+y*a,t[5]=o*h,t[9]=x-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,y=a*h,x=a*u;t[0]=l*h,t[4]=y*c-f,t[8]=d*c+x,t[1]=l*u,t[5]=x*c+d,t[9]=f*c-y,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,y=a*l,x=a*c;t[0]=l*h,t[4]=x-d*u,t[8]=y*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+y,t[10]=d-x*u}else if(e.order==="XZY"){let d=o*l,f=o*c,y=a*l,x=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+x,t[5]=o*h,t[9]=f*u-y,t[2]=y*u-f,t[6]=a*h,t[10]=x*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(Mx,e,Sx)}lookAt(e,t,n){let s=this.elements;return Nn.subVectors(e,t),Nn.lengthSq()===0&&(Nn.z=1),Nn.normalize(),ss.crossVectors(n,Nn),ss.lengthSq()===0&&(Math.abs(n.z)===1?Nn.x+=1e-4:Nn.z+=1e-4,Nn.normalize(),ss.crossVectors(n,Nn)),ss.normalize(),wa.crossVectors(Nn,ss),s[0]=ss.x,s[4]=wa.x,s[8]=Nn.x,s[1]=ss.y,s[5]=wa.y,s[9]=Nn.y,s[2]=ss.z,s[6]=wa.z,s[10]=Nn.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],y=n[2],x=n[6],m=n[10],g=n[14],S=n[3],M=n[7],_=n[11],T=n[15],w=s[0],p=s[4],v=s[8],C=s[12],R=s[1],I=s[5],D=s[9],B=s[13],P=s[2],G=s[6],W=s[10],k=s[14],Q=s[3],q=s[7],ee=s[11],te=s[15];return r[0]=o*w+a*R+l*P+c*Q,r[4]=o*p+a*I+l*G+c*q,r[8]=o*v+a*D+l*W+c*ee,r[12]=o*C+a*B+l*k+c*te,r[1]=h*w+u*R+d*P+f*Q,r[5]=h*p+u*I+d*G+f*q,r[9]=h*v+u*D+d*W+f*ee,r[13]=h*C+u*B+d*k+f*te,r[2]=y*w+x*R+m*P+g*Q,r[6]=y*p+x*I+m*G+g*q,r[10]=y*v+x*D+m*W+g*ee,r[14]=y*C+x*B+m*k+g*te,r[3]=S*w+M*R+_*P+T*Q,r[7]=S*p+M*I+_*G+T*q,r[11]=S*v+M*D+_*W+T*ee,r[15]=S*C+M*B+_*k+T*te,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],y=e[3],x=e[7],m=e[11],g=e[15],S=l*f-c*d,M=a*f-c*u,_=a*d-l*u,T=o*f-c*h,w=o*d-l*h,p=o*u-a*h;return t*(x*S-m*M+g*_)-n*(y*S-m*T+g*w)+s*(y*M-x*T+g*p)-r*(y*_-x*w+m*p)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],y=e[12],x=e[13],m=e[14],g=e[15],S=t*a-n*o,M=t*l-s*o,_=t*c-r*o,T=n*l-s*a,w=n*c-r*a,p=s*c-r*l,v=h*x-u*y,C=h*m-d*y,R=h*g-f*y,I=u*m-d*x,D=u*g-f*x,B=d*g-f*m,P=S*B-M*D+_*I+T*R-w*C+p*v;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let G=1/P;return e[0]=(a*B-l*D+c*I)*G,e[1]=(s*D-n*B-r*I)*G,e[2]=(x*p-m*w+g*T)*G,e[3]=(d*w-u*p-f*T)*G,e[4]=(l*R-o*B-c*C)*G,e[5]=(t*B-s*R+r*C)*G,e[6]=(m*_-y*p-g*M)*G,e[7]=(h*p-d*_+f*M)*G,e[8]=(o*D-a*R+c*v)*G,e[9]=(n*R-t*D-r*v)*G,e[10]=(y*w-x*_+g*S)*G,e[11]=(u*_-h*w-f*S)*G,e[12]=(a*C-o*I-l*v)*G,e[13]=(t*I-n*C+s*v)*G,e[14]=(x*M-y*T-m*S)*G,e[15]=(h*T-u*M+d*S)*G,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,y=r*u,x=o*h,m=o*u,g=a*u,S=l*c,M=l*h,_=l*u,T=n.x,w=n.y,p=n.z;return s[0]=(1-(x+g))*T,s[1]=(f+_)*T,s[2]=(y-M)*T,s[3]=0,s[4]=(f-_)*w,s[5]=(1-(d+g))*w,s[6]=(m+S)*w,s[7]=0,s[8]=(y+M)*p,s[9]=(m-S)*p,s[10]=(1-(d+x))*p,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=lr.set(s[0],s[1],s[2]).length(),a=lr.set(s[4],s[5],s[6]).length(),l=lr.set(s[8],s[9],s[10]).length();r<0&&(o=-o),ii.copy(this);let c=1/o,h=1/a,u=1/l;return ii.elements[0]*=c,ii.elements[1]*=c,ii.elements[2]*=c,ii.elements[4]*=h,ii.elements[5]*=h,ii.elements[6]*=h,ii.elements[8]*=u,ii.elements[9]*=u,ii.elements[10]*=u,t.setFromRotationMatrix(ii),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=qn,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(n-s),d=(t+e)/(t-e),f=(n+s)/(n-s),y,x;if(l)y=r/(o-r),x=o*r/(o-r);else if(a===qn)y=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===wr)y=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=y,c[14]=x,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=qn,l=!1){let c=this.elements,h=2/(t-e),u=2/(n-s),d=-(t+e)/(t-e),f=-(n+s)/(n-s),y,x;if(l)y=1/(o-r),x=o/(o-r);else if(a===qn)y=-2/(o-r),x=-(o+r)/(o-r);else if(a===wr)y=-1/(o-r),x=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=y,c[14]=x,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},lr=new U,ii=new ke,Mx=new U(0,0,0),Sx=new U(1,1,1),ss=new U,wa=new U,Nn=new U,lp=new ke,cp=new sn,ai=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(Ye(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Ye(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Ye(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Ye(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Ye(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-Ye(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Re("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return lp.makeRotationFromQuaternion(e),this.setFromRotationMatrix(lp,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return cp.setFromEuler(this),this.setFromQuaternion(cp,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};ai.DEFAULT_ORDER="XYZ";var Rr=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},wx=0,hp=new U,cr=new sn,Ri=new ke,Aa=new U,ao=new U,Ax=new U,Tx=new sn,up=new U(1,0,0),dp=new U(0,1,0),fp=new U(0,0,1),pp={type:"added"},Ex={type:"removed"},hr={type:"childadded",child:null},qh={type:"childremoved",child:null},xt=class i extends oi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:wx++}),this.uuid=bi(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new U,t=new ai,n=new sn,s=new U(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new ke},normalMatrix:{value:new Ue}}),this.matrix=new ke,this.matrixWorld=new ke,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Rr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return cr.setFromAxisAngle(e,t),this.quaternion.multiply(cr),this}rotateOnWorldAxis(e,t){return cr.setFromAxisAngle(e,t),this.quaternion.premultiply(cr),this}rotateX(e){return this.rotateOnAxis(up,e)}rotateY(e){return this.rotateOnAxis(dp,e)}rotateZ(e){return this.rotateOnAxis(fp,e)}translateOnAxis(e,t){return hp.copy(e).applyQuaternion(this.quaternion),this.position.add(hp.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(up,e)}translateY(e){return this.translateOnAxis(dp,e)}translateZ(e){return this.translateOnAxis(fp,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Ri.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?Aa.copy(e):Aa.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),ao.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Ri.lookAt(ao,Aa,this.up):Ri.lookAt(Aa,ao,this.up),this.quaternion.setFromRotationMatrix(Ri),s&&(Ri.extractRotation(s.matrixWorld),cr.setFromRotationMatrix(Ri),this.quaternion.premultiply(cr.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(De("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(pp),hr.child=e,this.dispatchEvent(hr),hr.child=null):De("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(Ex),qh.child=e,this.dispatchEvent(qh),qh.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Ri.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Ri.multiply(e.parent.matrixWorld)),e.applyMatrix4(Ri),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(pp),hr.child=e,this.dispatchEvent(hr),hr.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ao,e,Ax),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ao,Tx,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),y=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),y.length>0&&(n.nodes=y)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};xt.DEFAULT_UP=new U(0,1,0);xt.DEFAULT_MATRIX_AUTO_UPDATE=!0;xt.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var On=class extends xt{constructor(){super(),this.isGroup=!0,this.type="Group"}},Rx={type:"move"},Cr=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new On,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new On,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new U,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new U),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new On,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new U,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new U,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let x of e.hand.values()){let m=t.getJointPose(x,n),g=this._getHandJoint(c,x);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,y=.005;c.inputState.pinching&&d>f+y?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-y&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Rx)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new On;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},Rm={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},rs={h:0,s:0,l:0},Ta={h:0,s:0,l:0};function $h(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var be=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=dt){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,$e.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=$e.workingColorSpace){return this.r=e,this.g=t,this.b=n,$e.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=$e.workingColorSpace){if(e=ju(e,1),t=Ye(t,0,1),n=Ye(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=$h(o,r,e+1/3),this.g=$h(o,r,e),this.b=$h(o,r,e-1/3)}return $e.colorSpaceToWorking(this,s),this}setStyle(e,t=dt){function n(r){r!==void 0&&parseFloat(r)<1&&Re("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Re("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Re("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=dt){let n=Rm[e.toLowerCase()];return n!==void 0?this.setHex(n,t):Re("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Di(e.r),this.g=Di(e.g),this.b=Di(e.b),this}copyLinearToSRGB(e){return this.r=br(e.r),this.g=br(e.g),this.b=br(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=dt){return $e.workingToColorSpace(nn.copy(this),e),Math.round(Ye(nn.r*255,0,255))*65536+Math.round(Ye(nn.g*255,0,255))*256+Math.round(Ye(nn.b*255,0,255))}getHexString(e=dt){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=$e.workingColorSpace){$e.workingToColorSpace(nn.copy(this),t);let n=nn.r,s=nn.g,r=nn.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=$e.workingColorSpace){return $e.workingToColorSpace(nn.copy(this),t),e.r=nn.r,e.g=nn.g,e.b=nn.b,e}getStyle(e=dt){$e.workingToColorSpace(nn.copy(this),e);let t=nn.r,n=nn.g,s=nn.b;return e!==dt?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(rs),this.setHSL(rs.h+e,rs.s+t,rs.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(rs),e.getHSL(Ta);let n=xo(rs.h,Ta.h,t),s=xo(rs.s,Ta.s,t),r=xo(rs.l,Ta.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},nn=new be;be.NAMES=Rm;var Sn=class extends xt{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new ai,this.environmentIntensity=1,this.environmentRotation=new ai,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},si=new U,Ci=new U,Yh=new U,Pi=new U,ur=new U,dr=new U,mp=new U,Kh=new U,jh=new U,Jh=new U,Zh=new it,Qh=new it,eu=new it,hs=class i{constructor(e=new U,t=new U,n=new U){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),si.subVectors(e,t),s.cross(si);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){si.subVectors(s,t),Ci.subVectors(n,t),Yh.subVectors(e,t);let o=si.dot(si),a=si.dot(Ci),l=si.dot(Yh),c=Ci.dot(Ci),h=Ci.dot(Yh),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,y=(o*h-a*l)*d;return r.set(1-f-y,y,f)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,Pi)===null?!1:Pi.x>=0&&Pi.y>=0&&Pi.x+Pi.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,Pi)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Pi.x),l.addScaledVector(o,Pi.y),l.addScaledVector(a,Pi.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return Zh.setScalar(0),Qh.setScalar(0),eu.setScalar(0),Zh.fromBufferAttribute(e,t),Qh.fromBufferAttribute(e,n),eu.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(Zh,r.x),o.addScaledVector(Qh,r.y),o.addScaledVector(eu,r.z),o}static isFrontFacing(e,t,n,s){return si.subVectors(n,t),Ci.subVectors(e,t),si.cross(Ci).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return si.subVectors(this.c,this.b),Ci.subVectors(this.a,this.b),si.cross(Ci).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;ur.subVectors(s,n),dr.subVectors(r,n),Kh.subVectors(e,n);let l=ur.dot(Kh),c=dr.dot(Kh);if(l<=0&&c<=0)return t.copy(n);jh.subVectors(e,s);let h=ur.dot(jh),u=dr.dot(jh);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(ur,o);Jh.subVectors(e,r);let f=ur.dot(Jh),y=dr.dot(Jh);if(y>=0&&f<=y)return t.copy(r);let x=f*c-l*y;if(x<=0&&c>=0&&y<=0)return a=c/(c-y),t.copy(n).addScaledVector(dr,a);let m=h*y-f*u;if(m<=0&&u-h>=0&&f-y>=0)return mp.subVectors(r,s),a=(u-h)/(u-h+(f-y)),t.copy(s).addScaledVector(mp,a);let g=1/(m+x+d);return o=x*g,a=d*g,t.copy(n).addScaledVector(ur,o).addScaledVector(dr,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},gn=class{constructor(e=new U(1/0,1/0,1/0),t=new U(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(ri.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(ri.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=ri.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,ri):ri.fromBufferAttribute(r,o),ri.applyMatrix4(e.matrixWorld),this.expandByPoint(ri);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),Ea.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Ea.copy(n.boundingBox)),Ea.applyMatrix4(e.matrixWorld),this.union(Ea)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,ri),ri.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(lo),Ra.subVectors(this.max,lo),fr.subVectors(e.a,lo),pr.subVectors(e.b,lo),mr.subVectors(e.c,lo),os.subVectors(pr,fr),as.subVectors(mr,pr),Cs.subVectors(fr,mr);let t=[0,-os.z,os.y,0,-as.z,as.y,0,-Cs.z,Cs.y,os.z,0,-os.x,as.z,0,-as.x,Cs.z,0,-Cs.x,-os.y,os.x,0,-as.y,as.x,0,-Cs.y,Cs.x,0];return!tu(t,fr,pr,mr,Ra)||(t=[1,0,0,0,1,0,0,0,1],!tu(t,fr,pr,mr,Ra))?!1:(Ca.crossVectors(os,as),t=[Ca.x,Ca.y,Ca.z],tu(t,fr,pr,mr,Ra))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,ri).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(ri).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Ii[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Ii[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Ii[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Ii[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Ii[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Ii[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Ii[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Ii[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Ii),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Ii=[new U,new U,new U,new U,new U,new U,new U,new U],ri=new U,Ea=new gn,fr=new U,pr=new U,mr=new U,os=new U,as=new U,Cs=new U,lo=new U,Ra=new U,Ca=new U,Ps=new U;function tu(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Ps.fromArray(i,r);let a=s.x*Math.abs(Ps.x)+s.y*Math.abs(Ps.y)+s.z*Math.abs(Ps.z),l=e.dot(Ps),c=t.dot(Ps),h=n.dot(Ps);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Pt=new U,Pa=new Ee,Cx=0,ze=class extends oi{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:Cx++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=Yu,this.updateRanges=[],this.gpuType=Jt,this.version=0,this._normalizationScale=e!==void 0?rc(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)Pa.fromBufferAttribute(this,t),Pa.applyMatrix3(e),this.setXY(t,Pa.x,Pa.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)Pt.fromBufferAttribute(this,t),Pt.applyMatrix3(e),this.setXYZ(t,Pt.x,Pt.y,Pt.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)Pt.fromBufferAttribute(this,t),Pt.applyMatrix4(e),this.setXYZ(t,Pt.x,Pt.y,Pt.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)Pt.fromBufferAttribute(this,t),Pt.applyNormalMatrix(e),this.setXYZ(t,Pt.x,Pt.y,Pt.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)Pt.fromBufferAttribute(this,t),Pt.transformDirection(e),this.setXYZ(t,Pt.x,Pt.y,Pt.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Zu(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Qu(e,this.array)}},Fs=class extends ze{constructor(e,t,n){super(new Int8Array(e),t,n)}},Mo=class extends ze{constructor(e,t,n){super(new Uint8Array(e),t,n)}};var So=class extends ze{constructor(e,t,n){super(new Int16Array(e),t,n)}},Bs=class extends ze{constructor(e,t,n){super(new Uint16Array(e),t,n)}},wo=class extends ze{constructor(e,t,n){super(new Int32Array(e),t,n)}},ks=class extends ze{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var gt=class extends ze{constructor(e,t,n){super(new Float32Array(e),t,n)}},Px=new gn,co=new U,nu=new U,It=class{constructor(e=new U,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):Px.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;co.subVectors(e,this.center);let t=co.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(co,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(nu.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(co.copy(e.center).add(nu)),this.expandByPoint(co.copy(e.center).sub(nu))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},Ix=0,Wn=new ke,iu=new xt,gr=new U,Dn=new gn,ho=new gn,Xt=new U,Je=class i extends oi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Ix++}),this.uuid=bi(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(nx(e)?ks:Bs)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new Ue().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Wn.makeRotationFromQuaternion(e),this.applyMatrix4(Wn),this}rotateX(e){return Wn.makeRotationX(e),this.applyMatrix4(Wn),this}rotateY(e){return Wn.makeRotationY(e),this.applyMatrix4(Wn),this}rotateZ(e){return Wn.makeRotationZ(e),this.applyMatrix4(Wn),this}translate(e,t,n){return Wn.makeTranslation(e,t,n),this.applyMatrix4(Wn),this}scale(e,t,n){return Wn.makeScale(e,t,n),this.applyMatrix4(Wn),this}lookAt(e){return iu.lookAt(e),iu.updateMatrix(),this.applyMatrix4(iu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(gr).negate(),this.translate(gr.x,gr.y,gr.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new gt(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Re("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new gn);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){De("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new U(-1/0,-1/0,-1/0),new U(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];Dn.setFromBufferAttribute(r),this.morphTargetsRelative?(Xt.addVectors(this.boundingBox.min,Dn.min),this.boundingBox.expandByPoint(Xt),Xt.addVectors(this.boundingBox.max,Dn.max),this.boundingBox.expandByPoint(Xt)):(this.boundingBox.expandByPoint(Dn.min),this.boundingBox.expandByPoint(Dn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&De('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new It);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){De("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new U,1/0);return}if(e){let n=this.boundingSphere.center;if(Dn.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];ho.setFromBufferAttribute(a),this.morphTargetsRelative?(Xt.addVectors(Dn.min,ho.min),Dn.expandByPoint(Xt),Xt.addVectors(Dn.max,ho.max),Dn.expandByPoint(Xt)):(Dn.expandByPoint(ho.min),Dn.expandByPoint(ho.max))}Dn.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)Xt.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(Xt));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Xt.fromBufferAttribute(a,c),l&&(gr.fromBufferAttribute(e,c),Xt.add(gr)),s=Math.max(s,n.distanceToSquared(Xt))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&De('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){De("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new ze(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let C=0;C<n.count;C++)a[C]=new U,l[C]=new U;let h=new U,u=new U,d=new U,f=new Ee,y=new Ee,x=new Ee,m=new U,g=new U;function S(C,R,I){c[C]=c[R]=c[I]=1,h.fromBufferAttribute(n,C),u.fromBufferAttribute(n,R),d.fromBufferAttribute(n,I),f.fromBufferAttribute(r,C),y.fromBufferAttribute(r,R),x.fromBufferAttribute(r,I),u.sub(h),d.sub(h),y.sub(f),x.sub(f);let D=1/(y.x*x.y-x.x*y.y);isFinite(D)&&(m.copy(u).multiplyScalar(x.y).addScaledVector(d,-y.y).multiplyScalar(D),g.copy(d).multiplyScalar(y.x).addScaledVector(u,-x.x).multiplyScalar(D),a[C].add(m),a[R].add(m),a[I].add(m),l[C].add(g),l[R].add(g),l[I].add(g))}let M=this.groups;M.length===0&&(M=[{start:0,count:e.count}]);for(let C=0,R=M.length;C<R;++C){let I=M[C],D=I.start,B=I.count;for(let P=D,G=D+B;P<G;P+=3)S(e.getX(P+0),e.getX(P+1),e.getX(P+2))}let _=new U,T=new U,w=new U,p=new U;function v(C){w.fromBufferAttribute(s,C),p.copy(w);let R=a[C];_.copy(R),_.sub(w.multiplyScalar(w.dot(R))).normalize(),T.crossVectors(p,R);let D=T.dot(l[C])<0?-1:1;o.setXYZW(C,_.x,_.y,_.z,D)}for(let C=0,R=n.count;C<R;++C)c[C]&&v(C);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new ze(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new U,r=new U,o=new U,a=new U,l=new U,c=new U,h=new U,u=new U;if(e)for(let d=0,f=e.count;d<f;d+=3){let y=e.getX(d+0),x=e.getX(d+1),m=e.getX(d+2);s.fromBufferAttribute(t,y),r.fromBufferAttribute(t,x),o.fromBufferAttribute(t,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,y),l.fromBufferAttribute(n,x),c.fromBufferAttribute(n,m),a.add(h),l.add(h),c.add(h),n.setXYZ(y,a.x,a.y,a.z),n.setXYZ(x,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)Xt.fromBufferAttribute(e,t),Xt.normalize(),e.setXYZ(t,Xt.x,Xt.y,Xt.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,y=0;for(let x=0,m=l.length;x<m;x++){a.isInterleavedBufferAttribute?f=l[x]*a.data.stride+a.offset:f=l[x]*h;for(let g=0;g<h;g++)d[y++]=c[f++]}return new ze(d,h,u)}if(this.index===null)return Re("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,n);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Pr=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=Yu,this.updateRanges=[],this.version=0,this.uuid=bi()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,n){e*=this.stride,n*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[n+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=gp(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let n=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(n,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=gp(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function gp(i){return i.buffer._uuid===void 0&&(i.buffer._uuid=bi()),i.byteOffset===0&&i.byteLength===i.buffer.byteLength?i.buffer._uuid:i.buffer._uuid+":"+i.byteOffset+":"+i.byteLength}var fn=new U,Ir=class i{constructor(e,t,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=n,this.normalized=s,this._normalizationScale=e!==void 0?rc(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,n=this.data.count;t<n;t++)fn.fromBufferAttribute(this,t),fn.applyMatrix4(e),this.setXYZ(t,fn.x,fn.y,fn.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)fn.fromBufferAttribute(this,t),fn.applyNormalMatrix(e),this.setXYZ(t,fn.x,fn.y,fn.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)fn.fromBufferAttribute(this,t),fn.transformDirection(e),this.setXYZ(t,fn.x,fn.y,fn.z);return this}getComponent(e,t){let n=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[e*this.data.stride+this.offset+t]=n,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,n){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.data.array[e+0]=t,this.data.array[e+1]=n,this}setXYZ(e,t,n,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){_o("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new ze(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new i(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){_o("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Zu(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Qu(e,this.data.array)}},su=new U,Lx=new U,Nx=new Ue,Un=class{constructor(e=new U(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=su.subVectors(n,t).cross(Lx.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(su),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||Nx.getNormalMatrix(e),s=this.coplanarPoint(su).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},Dx=0,Bt=class extends oi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Dx++}),this.uuid=bi(),this.name="",this.type="Material",this.blending=ys,this.side=vi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Cu,this.blendDst=Pu,this.blendEquation=Xs,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new be(0,0,0),this.blendAlpha=0,this.depthFunc=Mr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=xm,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=ja,this.stencilZFail=ja,this.stencilZPass=ja,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){Re(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Re(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new be().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new Un().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new Ee().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Ee().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var Li=new U,ru=new U,Ia=new U,La=new U,yi=class{constructor(e=new U,t=new U(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Li)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Li.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Li.copy(this.origin).addScaledVector(this.direction,t),Li.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){ru.copy(e).add(t).multiplyScalar(.5),Ia.copy(t).sub(e).normalize(),La.copy(this.origin).sub(ru);let r=e.distanceTo(t)*.5,o=-this.direction.dot(Ia),a=La.dot(this.direction),l=-La.dot(Ia),c=La.lengthSq(),h=Math.abs(1-o*o),u,d,f,y;if(h>0)if(u=o*l-a,d=o*a-l,y=r*h,u>=0)if(d>=-y)if(d<=y){let x=1/h;u*=x,d*=x,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-y?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=y?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(ru).addScaledVector(Ia,d),f}intersectSphere(e,t){if(e.radius<0)return null;Li.subVectors(e.center,this.origin);let n=Li.dot(this.direction),s=Li.dot(Li)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(n=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,Li)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,y=t.x-o.x,x=t.y-o.y,m=t.z-o.z,g=n.x-o.x,S=n.y-o.y,M=n.z-o.z,_=Math.abs(l),T=Math.abs(c),w=Math.abs(h),p,v,C,R,I,D,B,P,G,W,k,Q;if(_>=T&&_>=w?(C=l,D=u,G=y,Q=g,l>=0?(p=c,v=h,R=d,I=f,B=x,P=m,W=S,k=M):(p=h,v=c,R=f,I=d,B=m,P=x,W=M,k=S)):T>=w?(C=c,D=d,G=x,Q=S,c>=0?(p=h,v=l,R=f,I=u,B=m,P=y,W=M,k=g):(p=l,v=h,R=u,I=f,B=y,P=m,W=g,k=M)):(C=h,D=f,G=m,Q=M,h>=0?(p=l,v=c,R=u,I=d,B=y,P=x,W=g,k=S):(p=c,v=l,R=d,I=u,B=x,P=y,W=S,k=g)),C===0)return null;let q=p/C,ee=v/C,te=1/C,_e=R-q*D,Ae=I-ee*D,Y=B-q*G,re=P-ee*G,ve=W-q*Q,Pe=k-ee*Q,me=ve*re-Pe*Y,Oe=_e*Pe-Ae*ve,St=Y*Ae-re*_e;if(s){if(me<0||Oe<0||St<0)return null}else if((me<0||Oe<0||St<0)&&(me>0||Oe>0||St>0))return null;let Le=me+Oe+St;if(Le===0)return null;let nt=te*(me*D+Oe*G+St*Q);return(Le>0?nt<0:nt>0)?null:this.at(nt/Le,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},rn=class extends Bt{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new be(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ai,this.combine=Go,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},yp=new ke,Is=new yi,Na=new It,xp=new U,Da=new U,Ua=new U,Oa=new U,ou=new U,Fa=new U,vp=new U,Ba=new U,je=class extends xt{constructor(e=new Je,t=new rn){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){Fa.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(ou.fromBufferAttribute(u,e),o?Fa.addScaledVector(ou,h):Fa.addScaledVector(ou.sub(t),h))}t.add(Fa)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Na.copy(n.boundingSphere),Na.applyMatrix4(r),Is.copy(e.ray).recast(e.near),!(Na.containsPoint(Is.origin)===!1&&(Is.intersectSphere(Na,xp)===null||Is.origin.distanceToSquared(xp)>(e.far-e.near)**2))&&(yp.copy(r).invert(),Is.copy(e.ray).applyMatrix4(yp),!(n.boundingBox!==null&&Is.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,Is)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let y=0,x=d.length;y<x;y++){let m=d[y],g=o[m.materialIndex],S=Math.max(m.start,f.start),M=Math.min(a.count,Math.min(m.start+m.count,f.start+f.count));for(let _=S,T=M;_<T;_+=3){let w=a.getX(_),p=a.getX(_+1),v=a.getX(_+2);s=ka(this,g,e,n,c,h,u,w,p,v),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let y=Math.max(0,f.start),x=Math.min(a.count,f.start+f.count);for(let m=y,g=x;m<g;m+=3){let S=a.getX(m),M=a.getX(m+1),_=a.getX(m+2);s=ka(this,o,e,n,c,h,u,S,M,_),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let y=0,x=d.length;y<x;y++){let m=d[y],g=o[m.materialIndex],S=Math.max(m.start,f.start),M=Math.min(l.count,Math.min(m.start+m.count,f.start+f.count));for(let _=S,T=M;_<T;_+=3){let w=_,p=_+1,v=_+2;s=ka(this,g,e,n,c,h,u,w,p,v),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let y=Math.max(0,f.start),x=Math.min(l.count,f.start+f.count);for(let m=y,g=x;m<g;m+=3){let S=m,M=m+1,_=m+2;s=ka(this,o,e,n,c,h,u,S,M,_),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}}};function Ux(i,e,t,n,s,r,o,a){let l;if(e.side===jt?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===vi,a),l===null)return null;Ba.copy(a),Ba.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(Ba);return c<t.near||c>t.far?null:{distance:c,point:Ba.clone(),object:i}}function ka(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,Da),i.getVertexPosition(l,Ua),i.getVertexPosition(c,Oa);let h=Ux(i,e,t,n,Da,Ua,Oa,vp);if(h){let u=new U;hs.getBarycoord(vp,Da,Ua,Oa,u),s&&(h.uv=hs.getInterpolatedAttribute(s,a,l,c,u,new Ee)),r&&(h.uv1=hs.getInterpolatedAttribute(r,a,l,c,u,new Ee)),o&&(h.normal=hs.getInterpolatedAttribute(o,a,l,c,u,new U),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new U,materialIndex:0};hs.getNormal(Da,Ua,Oa,d.normal),h.face=d,h.barycoord=u}return h}var uo=new it,_p=new it,bp=new it,Ox=new it,Mp=new ke,za=new U,au=new It,Sp=new ke,lu=new yi,Ao=class extends je{constructor(e,t){super(e,t),this.isSkinnedMesh=!0,this.type="SkinnedMesh",this.bindMode=du,this.bindMatrix=new ke,this.bindMatrixInverse=new ke,this.boundingBox=null,this.boundingSphere=null}computeBoundingBox(){let e=this.geometry;this.boundingBox===null&&(this.boundingBox=new gn),this.boundingBox.makeEmpty();let t=e.getAttribute("position");for(let n=0;n<t.count;n++)this.getVertexPosition(n,za),this.boundingBox.expandByPoint(za)}computeBoundingSphere(){let e=this.geometry;this.boundingSphere===null&&(this.boundingSphere=new It),this.boundingSphere.makeEmpty();let t=e.getAttribute("position");for(let n=0;n<t.count;n++)this.getVertexPosition(n,za),this.boundingSphere.expandByPoint(za)}copy(e,t){return super.copy(e,t),this.bindMode=e.bindMode,this.bindMatrix.copy(e.bindMatrix),this.bindMatrixInverse.copy(e.bindMatrixInverse),this.skeleton=e.skeleton,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}raycast(e,t){let n=this.material,s=this.matrixWorld;n!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),au.copy(this.boundingSphere),au.applyMatrix4(s),e.ray.intersectsSphere(au)!==!1&&(Sp.copy(s).invert(),lu.copy(e.ray).applyMatrix4(Sp),!(this.boundingBox!==null&&lu.intersectsBox(this.boundingBox)===!1)&&this._computeIntersections(e,t,lu)))}getVertexPosition(e,t){return super.getVertexPosition(e,t),this.applyBoneTransform(e,t),t}bind(e,t){this.skeleton=e,t===void 0&&(this.updateMatrixWorld(!0),this.skeleton.calculateInverses(),t=this.matrixWorld),this.bindMatrix.copy(t),this.bindMatrixInverse.copy(t).invert()}pose(){this.skeleton.pose()}normalizeSkinWeights(){let e=new it,t=this.geometry.attributes.skinWeight;for(let n=0,s=t.count;n<s;n++){e.fromBufferAttribute(t,n);let r=1/e.manhattanLength();r!==1/0?e.multiplyScalar(r):e.set(1,0,0,0),t.setXYZW(n,e.x,e.y,e.z,e.w)}}updateMatrixWorld(e){super.updateMatrixWorld(e),this.bindMode===du?this.bindMatrixInverse.copy(this.matrixWorld).invert():this.bindMode===pm?this.bindMatrixInverse.copy(this.bindMatrix).invert():Re("SkinnedMesh: Unrecognized bindMode: "+this.bindMode)}applyBoneTransform(e,t){let n=this.skeleton,s=this.geometry;_p.fromBufferAttribute(s.attributes.skinIndex,e),bp.fromBufferAttribute(s.attributes.skinWeight,e),t.isVector4?(uo.copy(t),t.set(0,0,0,0)):(uo.set(t.x,t.y,t.z,1),t.set(0,0,0)),uo.applyMatrix4(this.bindMatrix);for(let r=0;r<4;r++){let o=bp.getComponent(r);if(o!==0){let a=_p.getComponent(r);Mp.multiplyMatrices(n.bones[a].matrixWorld,n.boneInverses[a]),t.addScaledVector(Ox.copy(uo).applyMatrix4(Mp),o)}}return t.isVector4&&(t.w=uo.w),t.applyMatrix4(this.bindMatrixInverse)}},Lr=class extends xt{constructor(){super(),this.isBone=!0,this.type="Bone"}},Fn=class extends Ft{constructor(e=null,t=1,n=1,s,r,o,a,l,c=Mt,h=Mt,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}},wp=new ke,Fx=new ke,To=class i{constructor(e=[],t=[]){this.uuid=bi(),this.bones=e.slice(0),this.boneInverses=t,this.boneMatrices=null,this.previousBoneMatrices=null,this.boneTexture=null,this.previousBoneTexture=null,this.init()}init(){let e=this.bones,t=this.boneInverses;if(this.boneMatrices=new Float32Array(e.length*16),t.length===0)this.calculateInverses();else if(e.length!==t.length){Re("Skeleton: Number of inverse bone matrices does not match amount of bones."),this.boneInverses=[];for(let n=0,s=this.bones.length;n<s;n++)this.boneInverses.push(new ke)}}calculateInverses(){this.boneInverses.length=0;for(let e=0,t=this.bones.length;e<t;e++){let n=new ke;this.bones[e]&&n.copy(this.bones[e].matrixWorld).invert(),this.boneInverses.push(n)}}pose(){for(let e=0,t=this.bones.length;e<t;e++){let n=this.bones[e];n&&n.matrixWorld.copy(this.boneInverses[e]).invert()}for(let e=0,t=this.bones.length;e<t;e++){let n=this.bones[e];n&&(n.parent&&n.parent.isBone?(n.matrix.copy(n.parent.matrixWorld).invert(),n.matrix.multiply(n.matrixWorld)):n.matrix.copy(n.matrixWorld),n.matrix.decompose(n.position,n.quaternion,n.scale))}}update(){let e=this.bones,t=this.boneInverses,n=this.boneMatrices,s=this.boneTexture;for(let r=0,o=e.length;r<o;r++){let a=e[r]?e[r].matrixWorld:Fx;wp.multiplyMatrices(a,t[r]),wp.toArray(n,r*16)}s!==null&&(s.needsUpdate=!0)}clone(){return new i(this.bones,this.boneInverses)}computeBoneTexture(){let e=Math.sqrt(this.bones.length*4);e=Math.ceil(e/4)*4,e=Math.max(e,4);let t=new Float32Array(e*e*4);t.set(this.boneMatrices);let n=new Fn(t,e,e,an,Jt);return n.needsUpdate=!0,this.boneMatrices=t,this.boneTexture=n,this}getBoneByName(e){for(let t=0,n=this.bones.length;t<n;t++){let s=this.bones[t];if(s.name===e)return s}}dispose(){this.boneTexture!==null&&(this.boneTexture.dispose(),this.boneTexture=null),this.previousBoneTexture!==null&&(this.previousBoneTexture.dispose(),this.previousBoneTexture=null)}fromJSON(e,t){this.uuid=e.uuid;for(let n=0,s=e.bones.length;n<s;n++){let r=e.bones[n],o=t[r];o===void 0&&(Re("Skeleton: No bone found with UUID:",r),o=new Lr),this.bones.push(o),this.boneInverses.push(new ke().fromArray(e.boneInverses[n]))}return this.init(),this}toJSON(){let e={metadata:{version:4.7,type:"Skeleton",generator:"Skeleton.toJSON"},bones:[],boneInverses:[]};e.uuid=this.uuid;let t=this.bones,n=this.boneInverses;for(let s=0,r=t.length;s<r;s++){let o=t[s];e.bones.push(o.uuid);let a=n[s];e.boneInverses.push(a.toArray())}return e}},wn=class extends ze{constructor(e,t,n,s=1){super(e,t,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}},yr=new ke,Ap=new ke,Va=[],Tp=new gn,Bx=new ke,fo=new je,po=new It,zs=class extends je{constructor(e,t,n){super(e,t),this.isInstancedMesh=!0,this.instanceMatrix=new wn(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,Bx)}computeBoundingBox(){let e=this.geometry,t=this.count;this.boundingBox===null&&(this.boundingBox=new gn),e.boundingBox===null&&e.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,yr),Tp.copy(e.boundingBox).applyMatrix4(yr),this.boundingBox.union(Tp)}computeBoundingSphere(){let e=this.geometry,t=this.count;this.boundingSphere===null&&(this.boundingSphere=new It),e.boundingSphere===null&&e.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,yr),po.copy(e.boundingSphere).applyMatrix4(yr),this.boundingSphere.union(po)}copy(e,t){return super.copy(e,t),this.instanceMatrix.copy(e.instanceMatrix),this.morphTexture=e.morphTexture!==null?e.morphTexture.clone():null,this.instanceColor=e.instanceColor!==null?e.instanceColor.clone():null,this.count=e.count,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}getColorAt(e,t){return this.instanceColor===null?t.setRGB(1,1,1):t.fromArray(this.instanceColor.array,e*3)}getMatrixAt(e,t){return t.fromArray(this.instanceMatrix.array,e*16)}getMorphAt(e,t){let n=t.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=e*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(e,t){let n=this.matrixWorld,s=this.count;if(fo.geometry=this.geometry,fo.material=this.material,fo.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),po.copy(this.boundingSphere),po.applyMatrix4(n),e.ray.intersectsSphere(po)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,yr),Ap.multiplyMatrices(n,yr),fo.matrixWorld=Ap,fo.raycast(e,Va);for(let o=0,a=Va.length;o<a;o++){let l=Va[o];l.instanceId=r,l.object=this,t.push(l)}Va.length=0}}setColorAt(e,t){return this.instanceColor===null&&(this.instanceColor=new wn(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),t.toArray(this.instanceColor.array,e*3),this}setMatrixAt(e,t){return t.toArray(this.instanceMatrix.array,e*16),this}setMorphAt(e,t){let n=t.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new Fn(new Float32Array(s*this.count),s,this.count,Tl,Jt));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*e;return r[l]=a,r.set(n,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},Ls=new It,kx=new Ee(.5,.5),Ha=new U,us=class{constructor(e=new Un,t=new Un,n=new Un,s=new Un,r=new Un,o=new Un){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=qn,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],y=r[8],x=r[9],m=r[10],g=r[11],S=r[12],M=r[13],_=r[14],T=r[15];if(s[0].setComponents(c-o,f-h,g-y,T-S).normalize(),s[1].setComponents(c+o,f+h,g+y,T+S).normalize(),s[2].setComponents(c+a,f+u,g+x,T+M).normalize(),s[3].setComponents(c-a,f-u,g-x,T-M).normalize(),n)s[4].setComponents(l,d,m,_).normalize(),s[5].setComponents(c-l,f-d,g-m,T-_).normalize();else if(s[4].setComponents(c-l,f-d,g-m,T-_).normalize(),t===qn)s[5].setComponents(c+l,f+d,g+m,T+_).normalize();else if(t===wr)s[5].setComponents(l,d,m,_).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Ls.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Ls.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Ls)}intersectsSprite(e){Ls.center.set(0,0,0);let t=kx.distanceTo(e.center);return Ls.radius=.7071067811865476+t,Ls.applyMatrix4(e.matrixWorld),this.intersectsSphere(Ls)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(Ha.x=s.normal.x>0?e.max.x:e.min.x,Ha.y=s.normal.y>0?e.max.y:e.min.y,Ha.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Ha)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Ep=new ke,al=class i{constructor(){this.coordinateSystem=qn,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];Ep.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new us),n[s].setFromProjectionMatrix(Ep,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new us),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};var yn=class extends Bt{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new be(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},ll=new U,cl=new U,Rp=new ke,mo=new yi,Ga=new It,cu=new U,Cp=new U,Vs=class extends xt{constructor(e=new Je,t=new yn){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)ll.fromBufferAttribute(t,s-1),cl.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=ll.distanceTo(cl);e.setAttribute("lineDistance",new gt(n,1))}else Re("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ga.copy(n.boundingSphere),Ga.applyMatrix4(s),Ga.radius+=r,e.ray.intersectsSphere(Ga)===!1)return;Rp.copy(s).invert(),mo.copy(e.ray).applyMatrix4(Rp);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,d=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),y=Math.min(h.count,o.start+o.count);for(let x=f,m=y-1;x<m;x+=c){let g=h.getX(x),S=h.getX(x+1),M=Wa(this,e,mo,l,g,S,x);M&&t.push(M)}if(this.isLineLoop){let x=h.getX(y-1),m=h.getX(f),g=Wa(this,e,mo,l,x,m,y-1);g&&t.push(g)}}else{let f=Math.max(0,o.start),y=Math.min(d.count,o.start+o.count);for(let x=f,m=y-1;x<m;x+=c){let g=Wa(this,e,mo,l,x,x+1,x);g&&t.push(g)}if(this.isLineLoop){let x=Wa(this,e,mo,l,y-1,f,y-1);x&&t.push(x)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Wa(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(ll.fromBufferAttribute(a,s),cl.fromBufferAttribute(a,r),t.distanceSqToSegment(ll,cl,cu,Cp)>n)return;cu.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(cu);if(!(c<e.near||c>e.far))return{distance:c,point:Cp.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var Pp=new U,Ip=new U,Bn=class extends Vs{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)Pp.fromBufferAttribute(t,s),Ip.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+Pp.distanceTo(Ip);e.setAttribute("lineDistance",new gt(n,1))}else Re("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}},Eo=class extends Vs{constructor(e,t){super(e,t),this.isLineLoop=!0,this.type="LineLoop"}},li=class extends Bt{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new be(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},Lp=new ke,yu=new yi,Xa=new It,qa=new U,Oi=class extends xt{constructor(e=new Je,t=new li){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Xa.copy(n.boundingSphere),Xa.applyMatrix4(s),Xa.radius+=r,e.ray.intersectsSphere(Xa)===!1)return;Lp.copy(s).invert(),yu.copy(e.ray).applyMatrix4(Lp);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let y=d,x=f;y<x;y++){let m=c.getX(y);qa.fromBufferAttribute(u,m),Np(qa,m,l,s,e,t,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let y=d,x=f;y<x;y++)qa.fromBufferAttribute(u,y),Np(qa,y,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Np(i,e,t,n,s,r,o){let a=yu.distanceSqToPoint(i);if(a<t){let l=new U;yu.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var Ro=class extends Ft{constructor(e=[],t=qs,n,s,r,o,a,l,c,h){super(e,t,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},Co=class extends Ft{constructor(e,t,n,s,r,o,a,l,c){super(e,t,n,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Fi=class extends Ft{constructor(e,t,n=Cn,s,r,o,a=Mt,l=Mt,c,h=Ui,u=1){if(h!==Ui&&h!==qi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Er(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},Po=class extends Fi{constructor(e,t=Cn,n=qs,s,r,o=Mt,a=Mt,l,c=Ui){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},Io=class extends Ft{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},ds=class i extends Je{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;y("z","y","x",-1,-1,n,t,e,o,r,0),y("z","y","x",1,-1,n,t,-e,o,r,1),y("x","z","y",1,1,e,n,t,s,o,2),y("x","z","y",1,-1,e,n,-t,s,o,3),y("x","y","z",1,-1,e,t,n,s,r,4),y("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new gt(c,3)),this.setAttribute("normal",new gt(h,3)),this.setAttribute("uv",new gt(u,2));function y(x,m,g,S,M,_,T,w,p,v,C){let R=_/p,I=T/v,D=_/2,B=T/2,P=w/2,G=p+1,W=v+1,k=0,Q=0,q=new U;for(let ee=0;ee<W;ee++){let te=ee*I-B;for(let _e=0;_e<G;_e++){let Ae=_e*R-D;q[x]=Ae*S,q[m]=te*M,q[g]=P,c.push(q.x,q.y,q.z),q[x]=0,q[m]=0,q[g]=w>0?1:-1,h.push(q.x,q.y,q.z),u.push(_e/p),u.push(1-ee/v),k+=1}}for(let ee=0;ee<v;ee++)for(let te=0;te<p;te++){let _e=d+te+G*ee,Ae=d+te+G*(ee+1),Y=d+(te+1)+G*(ee+1),re=d+(te+1)+G*ee;l.push(_e,Ae,re),l.push(Ae,Y,re),Q+=6}a.addGroup(f,Q,C),f+=Q,d+=k}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var fs=class i extends Je{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],y=[],x=[],m=[];for(let g=0;g<h;g++){let S=g*d-o;for(let M=0;M<c;M++){let _=M*u-r;y.push(_,-S,0),x.push(0,0,1),m.push(M/a),m.push(1-g/l)}}for(let g=0;g<l;g++)for(let S=0;S<a;S++){let M=S+c*g,_=S+c*(g+1),T=S+1+c*(g+1),w=S+1+c*g;f.push(M,_,w),f.push(_,T,w)}this.setIndex(f),this.setAttribute("position",new gt(y,3)),this.setAttribute("normal",new gt(x,3)),this.setAttribute("uv",new gt(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};function js(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(Dp(s))s.isRenderTargetTexture?(Re("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(Dp(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function ln(i){let e={};for(let t=0;t<i.length;t++){let n=js(i[t]);for(let s in n)e[s]=n[s]}return e}function Dp(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function zx(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function ed(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:$e.workingColorSpace}var Cm={clone:js,merge:ln},Vx=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Hx=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,An=class extends Bt{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Vx,this.fragmentShader=Hx,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=js(e.uniforms),this.uniformsGroups=zx(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new be().setHex(s.value);break;case"v2":this.uniforms[n].value=new Ee().fromArray(s.value);break;case"v3":this.uniforms[n].value=new U().fromArray(s.value);break;case"v4":this.uniforms[n].value=new it().fromArray(s.value);break;case"m3":this.uniforms[n].value=new Ue().fromArray(s.value);break;case"m4":this.uniforms[n].value=new ke().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},hl=class extends An{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}},Tn=class extends Bt{constructor(e){super(),this.isMeshStandardMaterial=!0,this.type="MeshStandardMaterial",this.defines={STANDARD:""},this.color=new be(16777215),this.roughness=1,this.metalness=0,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new be(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Gr,this.normalScale=new Ee(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.roughnessMap=null,this.metalnessMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ai,this.envMapIntensity=1,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.defines={STANDARD:""},this.color.copy(e.color),this.roughness=e.roughness,this.metalness=e.metalness,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.roughnessMap=e.roughnessMap,this.metalnessMap=e.metalnessMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.envMapIntensity=e.envMapIntensity,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},xn=class extends Tn{constructor(e){super(),this.isMeshPhysicalMaterial=!0,this.defines={STANDARD:"",PHYSICAL:""},this.type="MeshPhysicalMaterial",this.anisotropyRotation=0,this.anisotropyMap=null,this.clearcoatMap=null,this.clearcoatRoughness=0,this.clearcoatRoughnessMap=null,this.clearcoatNormalScale=new Ee(1,1),this.clearcoatNormalMap=null,this.diffuseRoughnessMap=null,this.ior=1.5,Object.defineProperty(this,"reflectivity",{get:function(){return Ye(2.5*(this.ior-1)/(this.ior+1),0,1)},set:function(t){this.ior=(1+.4*t)/(1-.4*t)}}),this.iridescenceMap=null,this.iridescenceIOR=1.3,this.iridescenceThicknessMinimum=100,this.iridescenceThicknessMaximum=400,this.iridescenceThicknessMap=null,this.sheenColor=new be(0),this.sheenColorMap=null,this.sheenRoughness=1,this.sheenRoughnessMap=null,this.transmissionMap=null,this.thickness=0,this.thicknessMap=null,this.attenuationDistance=1/0,this.attenuationColor=new be(1,1,1),this.specularIntensity=1,this.specularIntensityMap=null,this.specularColor=new be(1,1,1),this.specularColorMap=null,this._anisotropy=0,this._clearcoat=0,this._diffuseRoughness=0,this._dispersion=0,this._iridescence=0,this._retroreflectivity=0,this._sheen=0,this._transmission=0,this.setValues(e)}get anisotropy(){return this._anisotropy}set anisotropy(e){this._anisotropy>0!=e>0&&this.version++,this._anisotropy=e}get clearcoat(){return this._clearcoat}set clearcoat(e){this._clearcoat>0!=e>0&&this.version++,this._clearcoat=e}get diffuseRoughness(){return this._diffuseRoughness}set diffuseRoughness(e){this._diffuseRoughness>0!=e>0&&this.version++,this._diffuseRoughness=e}get iridescence(){return this._iridescence}set iridescence(e){this._iridescence>0!=e>0&&this.version++,this._iridescence=e}get dispersion(){return this._dispersion}set dispersion(e){this._dispersion>0!=e>0&&this.version++,this._dispersion=e}get retroreflectivity(){return this._retroreflectivity}set retroreflectivity(e){this._retroreflectivity>0!=e>0&&this.version++,this._retroreflectivity=e}get sheen(){return this._sheen}set sheen(e){this._sheen>0!=e>0&&this.version++,this._sheen=e}get transmission(){return this._transmission}set transmission(e){this._transmission>0!=e>0&&this.version++,this._transmission=e}get iridescenceThicknessRange(){return Ns('MeshPhysicalMaterial: The "iridescenceThicknessRange" property has been replaced by "iridescenceThicknessMinimum" and "iridescenceThicknessMaximum".'),[this.iridescenceThicknessMinimum,this.iridescenceThicknessMaximum]}set iridescenceThicknessRange(e){Ns('MeshPhysicalMaterial: The "iridescenceThicknessRange" property has been replaced by "iridescenceThicknessMinimum" and "iridescenceThicknessMaximum".'),this.iridescenceThicknessMinimum=e[0],this.iridescenceThicknessMaximum=e[1]}copy(e){return super.copy(e),this.defines={STANDARD:"",PHYSICAL:""},this.anisotropy=e.anisotropy,this.anisotropyRotation=e.anisotropyRotation,this.anisotropyMap=e.anisotropyMap,this.clearcoat=e.clearcoat,this.clearcoatMap=e.clearcoatMap,this.clearcoatRoughness=e.clearcoatRoughness,this.clearcoatRoughnessMap=e.clearcoatRoughnessMap,this.clearcoatNormalMap=e.clearcoatNormalMap,this.clearcoatNormalScale.copy(e.clearcoatNormalScale),this.diffuseRoughness=e.diffuseRoughness,this.diffuseRoughnessMap=e.diffuseRoughnessMap,this.dispersion=e.dispersion,this.ior=e.ior,this.iridescence=e.iridescence,this.iridescenceMap=e.iridescenceMap,this.iridescenceIOR=e.iridescenceIOR,this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum,this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum,this.iridescenceThicknessMap=e.iridescenceThicknessMap,this.retroreflectivity=e.retroreflectivity,this.sheen=e.sheen,this.sheenColor.copy(e.sheenColor),this.sheenColorMap=e.sheenColorMap,this.sheenRoughness=e.sheenRoughness,this.sheenRoughnessMap=e.sheenRoughnessMap,this.transmission=e.transmission,this.transmissionMap=e.transmissionMap,this.thickness=e.thickness,this.thicknessMap=e.thicknessMap,this.attenuationDistance=e.attenuationDistance,this.attenuationColor.copy(e.attenuationColor),this.specularIntensity=e.specularIntensity,this.specularIntensityMap=e.specularIntensityMap,this.specularColor.copy(e.specularColor),this.specularColorMap=e.specularColorMap,this}},Lo=class extends Bt{constructor(e){super(),this.isMeshPhongMaterial=!0,this.type="MeshPhongMaterial",this.color=new be(16777215),this.specular=new be(1118481),this.shininess=30,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new be(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Gr,this.normalScale=new Ee(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ai,this.combine=Go,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.specular.copy(e.specular),this.shininess=e.shininess,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}};var No=class extends Bt{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new be(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new be(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Gr,this.normalScale=new Ee(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ai,this.combine=Go,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},ul=class extends Bt{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=gm,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},dl=class extends Bt{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function cs(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function go(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}function Gx(i){function e(s,r){return i[s]-i[r]}let t=i.length,n=new Array(t);for(let s=0;s!==t;++s)n[s]=s;return n.sort(e),n}function Up(i,e,t){let n=i.length,s=new i.constructor(n);for(let r=0,o=0;o!==n;++r){let a=t[r]*e;for(let l=0;l!==e;++l)s[o++]=i[a+l]}return s}function Wx(i,e,t,n){let s=1,r=i[0];for(;r!==void 0&&r[n]===void 0;)r=i[s++];if(r===void 0)return;let o=r[n];if(o!==void 0)if(Array.isArray(o))do o=r[n],o!==void 0&&(e.push(r.time),t.push(...o)),r=i[s++];while(r!==void 0);else if(o.toArray!==void 0)do o=r[n],o!==void 0&&(e.push(r.time),o.toArray(t,t.length)),r=i[s++];while(r!==void 0);else do o=r[n],o!==void 0&&(e.push(r.time),t.push(o)),r=i[s++];while(r!==void 0)}var xi=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];e:{t:{let o;n:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break t}o=t.length;break n}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break t}o=n,n=0;break n}break e}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},fl=class extends xi{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:pu,endingEnd:pu}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case mu:r=e,a=2*t-n;break;case gu:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case mu:o=e,l=2*n-t;break;case gu:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,y=(n-t)/(s-t),x=y*y,m=x*y,g=-d*m+2*d*x-d*y,S=(1+d)*m+(-1.5-2*d)*x+(-.5+d)*y+1,M=(-1-f)*m+(1.5+f)*x+.5*y,_=f*m-f*x;for(let T=0;T!==a;++T)r[T]=g*o[h+T]+S*o[c+T]+M*o[l+T]+_*o[u+T];return r}},pl=class extends xi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},ml=class extends xi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},gl=class extends xi{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let y=(n-t)/(s-t),x=1-y;for(let m=0;m!==a;++m)r[m]=o[c+m]*x+o[l+m]*y;return r}let d=a*2,f=e-1;for(let y=0;y!==a;++y){let x=o[c+y],m=o[l+y],g=f*d+y*2,S=u[g],M=u[g+1],_=e*d+y*2,T=h[_],w=h[_+1],p=qx(n,t,S,T,s);r[y]=Pm(p,x,M,w,m)}return r}};function Pm(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function Xx(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function qx(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=Pm(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=Xx(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var En=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=cs(t,this.TimeBufferType),this.values=cs(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:cs(e.times,Array),values:cs(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),go(e.settings)&&(n.settings={inTangents:cs(e.settings.inTangents,Array),outTangents:cs(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new ml(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new pl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new fl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new gl(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Ds:t=this.InterpolantFactoryMethodDiscrete;break;case Us:t=this.InterpolantFactoryMethodLinear;break;case Ka:t=this.InterpolantFactoryMethodSmooth;break;case fu:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Re("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Ds;case this.InterpolantFactoryMethodLinear:return Us;case this.InterpolantFactoryMethodSmooth:return Ka;case this.InterpolantFactoryMethodBezier:return fu}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;go(this.settings)&&(Op(this.settings.inTangents,e),Op(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;go(this.settings)&&(Fp(this.settings.inTangents,e),Fp(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(De("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(De("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){De("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){De("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&ix(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){De("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Ka,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let y=0;y!==n;++y){let x=t[u+y];if(x!==t[d+y]||x!==t[f+y]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,go(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Op(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function Fp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}En.prototype.ValueTypeName="";En.prototype.TimeBufferType=Float32Array;En.prototype.ValueBufferType=Float32Array;En.prototype.DefaultInterpolation=Us;var Bi=class extends En{constructor(e,t,n){super(e,t,n)}};Bi.prototype.ValueTypeName="bool";Bi.prototype.ValueBufferType=Array;Bi.prototype.DefaultInterpolation=Ds;Bi.prototype.InterpolantFactoryMethodLinear=void 0;Bi.prototype.InterpolantFactoryMethodSmooth=void 0;var Do=class extends En{constructor(e,t,n,s){super(e,t,n,s)}};Do.prototype.ValueTypeName="color";var ki=class extends En{constructor(e,t,n,s){super(e,t,n,s)}};ki.prototype.ValueTypeName="number";var yl=class extends xi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)sn.slerpFlat(r,0,o,c-a,o,c,l);return r}},zi=class extends En{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new yl(this.times,this.values,this.getValueSize(),e)}};zi.prototype.ValueTypeName="quaternion";zi.prototype.InterpolantFactoryMethodSmooth=void 0;var Vi=class extends En{constructor(e,t,n){super(e,t,n)}};Vi.prototype.ValueTypeName="string";Vi.prototype.ValueBufferType=Array;Vi.prototype.DefaultInterpolation=Ds;Vi.prototype.InterpolantFactoryMethodLinear=void 0;Vi.prototype.InterpolantFactoryMethodSmooth=void 0;var ps=class extends En{constructor(e,t,n,s){super(e,t,n,s)}};ps.prototype.ValueTypeName="vector";var Uo=class{constructor(e="",t=-1,n=[],s=mm){this.name=e,this.tracks=n,this.duration=t,this.blendMode=s,this.uuid=bi(),this.userData={},this.duration<0&&this.resetDuration()}static parse(e){let t=[],n=e.tracks,s=1/(e.fps||1);for(let o=0,a=n.length;o!==a;++o)t.push(Yx(n[o]).scale(s));let r=new this(e.name,e.duration,t,e.blendMode);return r.uuid=e.uuid,r.userData=JSON.parse(e.userData||"{}"),r}static toJSON(e){let t=[],n=e.tracks,s={name:e.name,duration:e.duration,tracks:t,uuid:e.uuid,blendMode:e.blendMode,userData:JSON.stringify(e.userData)};for(let r=0,o=n.length;r!==o;++r)t.push(En.toJSON(n[r]));return s}static CreateFromMorphTargetSequence(e,t,n,s){let r=t.length,o=[];for(let a=0;a<r;a++){let l=[],c=[];l.push((a+r-1)%r,a,(a+1)%r),c.push(0,1,0);let h=Gx(l);l=Up(l,1,h),c=Up(c,1,h),!s&&l[0]===0&&(l.push(r),c.push(c[0])),o.push(new ki(".morphTargetInfluences["+t[a].name+"]",l,c).scale(1/n))}return new this(e,-1,o)}static findByName(e,t){let n=e;if(!Array.isArray(e)){let s=e;n=s.geometry&&s.geometry.animations||s.animations}for(let s=0;s<n.length;s++)if(n[s].name===t)return n[s];return null}static CreateClipsFromMorphTargetSequences(e,t,n){let s={},r=/^([\w-]*?)([\d]+)$/;for(let a=0,l=e.length;a<l;a++){let c=e[a],h=c.name.match(r);if(h&&h.length>1){let u=h[1],d=s[u];d||(s[u]=d=[]),d.push(c)}}let o=[];for(let a in s)o.push(this.CreateFromMorphTargetSequence(a,s[a],t,n));return o}resetDuration(){let e=this.tracks,t=0;for(let n=0,s=e.length;n!==s;++n){let r=this.tracks[n];t=Math.max(t,r.times[r.times.length-1])}return this.duration=t,this}trim(){for(let e=0;e<this.tracks.length;e++)this.tracks[e].trim(0,this.duration);return this}validate(){let e=!0;for(let t=0;t<this.tracks.length;t++)e=e&&this.tracks[t].validate();return e}optimize(){for(let e=0;e<this.tracks.length;e++)this.tracks[e].optimize();return this}clone(){let e=[];for(let n=0;n<this.tracks.length;n++)e.push(this.tracks[n].clone());let t=new this.constructor(this.name,this.duration,e,this.blendMode);return t.userData=JSON.parse(JSON.stringify(this.userData)),t}toJSON(){return this.constructor.toJSON(this)}};function $x(i){switch(i.toLowerCase()){case"scalar":case"double":case"float":case"number":case"integer":return ki;case"vector":case"vector2":case"vector3":case"vector4":return ps;case"color":return Do;case"quaternion":return zi;case"bool":case"boolean":return Bi;case"string":return Vi}throw new Error("THREE.KeyframeTrack: Unsupported typeName: "+i)}function Yx(i){if(i.type===void 0)throw new Error("THREE.KeyframeTrack: track type undefined, can not parse");let e=$x(i.type);if(i.times===void 0){let n=[],s=[];Wx(i.keys,n,s,"value"),i.times=n,i.values=s}let t;return e.parse!==void 0?t=e.parse(i):t=new e(i.name,i.times,i.values,i.interpolation),go(i.settings)&&(t.settings={inTangents:cs(i.settings.inTangents,Float32Array),outTangents:cs(i.settings.outTangents,Float32Array)}),t}var gi={enabled:!1,files:{},add:function(i,e){this.enabled!==!1&&(Bp(i)||(this.files[i]=e))},get:function(i){if(this.enabled!==!1&&!Bp(i))return this.files[i]},remove:function(i){delete this.files[i]},clear:function(){this.files={}}};function Bp(i){try{let e=i.slice(i.indexOf(":")+1);return new URL(e).protocol==="blob:"}catch{return!1}}var Nr=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],y=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return y}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Im=new Nr,on=class{constructor(e){this.manager=e!==void 0?e:Im,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};on.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ni={},xu=class extends Error{constructor(e,t){super(e),this.response=t}},Yn=class extends on{constructor(e){super(e),this.mimeType="",this.responseType="",this._abortController=new AbortController}load(e,t,n,s){e===void 0&&(e=""),this.path!==void 0&&(e=this.path+e),e=this.manager.resolveURL(e);let r=gi.get(`file:${e}`);if(r!==void 0){this.manager.itemStart(e),setTimeout(()=>{t&&t(r),this.manager.itemEnd(e)},0);return}if(Ni[e]!==void 0){Ni[e].push({onLoad:t,onProgress:n,onError:s});return}Ni[e]=[],Ni[e].push({onLoad:t,onProgress:n,onError:s});let o=new Request(e,{headers:new Headers(this.requestHeader),credentials:this.withCredentials?"include":"same-origin",priority:this.priority,cache:this.cache,signal:typeof AbortSignal.any=="function"?AbortSignal.any([this._abortController.signal,this.manager.abortController.signal]):this._abortController.signal}),a=this.mimeType,l=this.responseType;fetch(o).then(c=>{if(c.status===200||c.status===0){if(c.status===0&&Re("FileLoader: HTTP Status 0 received."),typeof ReadableStream>"u"||c.body===void 0||c.body.getReader===void 0)return c;let h=Ni[e],u=c.body.getReader(),d=c.headers.get("X-File-Size")||c.headers.get("Content-Length"),f=d?parseInt(d):0,y=f!==0,x=0,m=new ReadableStream({start(g){S();function S(){u.read().then(({done:M,value:_})=>{if(M)g.close();else{x+=_.byteLength;let T=new ProgressEvent("progress",{lengthComputable:y,loaded:x,total:f});for(let w=0,p=h.length;w<p;w++){let v=h[w];v.onProgress&&v.onProgress(T)}g.enqueue(_),S()}},M=>{g.error(M)})}}});return new Response(m)}else throw new xu(`fetch for "${c.url}" responded with ${c.status}: ${c.statusText}`,c)}).then(c=>{switch(l){case"arraybuffer":return c.arrayBuffer();case"blob":return c.blob();case"document":return c.text().then(h=>new DOMParser().parseFromString(h,a));case"json":return c.json();default:if(a==="")return c.text();{let u=/charset="?([^;"\s]*)"?/i.exec(a),d=u&&u[1]?u[1].toLowerCase():void 0,f=new TextDecoder(d);return c.arrayBuffer().then(y=>f.decode(y))}}}).then(c=>{gi.add(`file:${e}`,c);let h=Ni[e];delete Ni[e];for(let u=0,d=h.length;u<d;u++){let f=h[u];f.onLoad&&f.onLoad(c)}}).catch(c=>{let h=Ni[e];if(h===void 0)throw this.manager.itemError(e),c;delete Ni[e];for(let u=0,d=h.length;u<d;u++){let f=h[u];f.onError&&f.onError(c)}this.manager.itemError(e)}).finally(()=>{this.manager.itemEnd(e)}),this.manager.itemStart(e)}setResponseType(e){return this.responseType=e,this}setMimeType(e){return this.mimeType=e,this}abort(){return this._abortController.abort(),this._abortController=new AbortController,this}};var xr=new WeakMap,xl=class extends on{constructor(e){super(e)}load(e,t,n,s){this.path!==void 0&&(e=this.path+e),e=this.manager.resolveURL(e);let r=this,o=gi.get(`image:${e}`);if(o!==void 0){if(o.complete===!0)r.manager.itemStart(e),setTimeout(function(){t&&t(o),r.manager.itemEnd(e)},0);else{let u=xr.get(o);u===void 0&&(u=[],xr.set(o,u)),u.push({onLoad:t,onError:s})}return o}let a=Ar("img");function l(){h(),t&&t(this);let u=xr.get(this)||[];for(let d=0;d<u.length;d++){let f=u[d];f.onLoad&&f.onLoad(this)}xr.delete(this),r.manager.itemEnd(e)}function c(u){h(),s&&s(u),gi.remove(`image:${e}`);let d=xr.get(this)||[];for(let f=0;f<d.length;f++){let y=d[f];y.onError&&y.onError(u)}xr.delete(this),r.manager.itemError(e),r.manager.itemEnd(e)}function h(){a.removeEventListener("load",l,!1),a.removeEventListener("error",c,!1)}return a.addEventListener("load",l,!1),a.addEventListener("error",c,!1),e.slice(0,5)!=="data:"&&this.crossOrigin!==void 0&&(a.crossOrigin=this.crossOrigin),gi.add(`image:${e}`,a),r.manager.itemStart(e),a.fetchPriority=this.priority,a.src=e,a}};var Hi=class extends on{constructor(e){super(e)}load(e,t,n,s){let r=new Ft,o=new xl(this.manager);return o.setPriority(this.priority),o.setCache(this.cache),o.setCrossOrigin(this.crossOrigin),o.setPath(this.path),o.load(e,function(a){r.image=a,r.needsUpdate=!0,t!==void 0&&t(r)},n,s),r}},Hs=class extends xt{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new be(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},Gs=class extends Hs{constructor(e,t,n){super(e,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(xt.DEFAULT_UP),this.updateMatrix(),this.groundColor=new be(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},hu=new ke,kp=new U,zp=new U,Dr=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Ee(512,512),this.mapType=Rn,this.map=null,this.mapPass=null,this.matrix=new ke,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new us,this._frameExtents=new Ee(1,1),this._viewportCount=1,this._viewports=[new it(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;kp.setFromMatrixPosition(e.matrixWorld),t.position.copy(kp),zp.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(zp),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,n,s){hu.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),n.setFromProjectionMatrix(hu,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===wr||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(hu)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},$a=new U,Ya=new sn,mi=new U,Oo=class extends xt{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new ke,this.projectionMatrix=new ke,this.projectionMatrixInverse=new ke,this.coordinateSystem=qn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose($a,Ya,mi),mi.x===1&&mi.y===1&&mi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose($a,Ya,mi.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose($a,Ya,mi),mi.x===1&&mi.y===1&&mi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose($a,Ya,mi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ls=new U,Vp=new Ee,Hp=new Ee,Ut=class extends Oo{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Os*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(yo*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Os*2*Math.atan(Math.tan(yo*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){ls.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(ls.x,ls.y).multiplyScalar(-e/ls.z),ls.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ls.x,ls.y).multiplyScalar(-e/ls.z)}getViewSize(e,t){return this.getViewBounds(e,Vp,Hp),t.subVectors(Hp,Vp)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(yo*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}},vu=class extends Dr{constructor(){super(new Ut(50,1,.5,500)),this.isSpotLightShadow=!0,this.focus=1,this.aspect=1}updateMatrices(e){let t=this.camera,n=Os*2*e.angle*this.focus,s=this.mapSize.width/this.mapSize.height*this.aspect,r=e.distance||t.far;(n!==t.fov||s!==t.aspect||r!==t.far)&&(t.fov=n,t.aspect=s,t.far=r,t.updateProjectionMatrix()),super.updateMatrices(e)}copy(e){return super.copy(e),this.focus=e.focus,this.aspect=e.aspect,this}toJSON(){let e=super.toJSON();return e.focus=this.focus,e.aspect=this.aspect,e}},Fo=class extends Hs{constructor(e,t,n=0,s=Math.PI/3,r=0,o=2){super(e,t),this.isSpotLight=!0,this.type="SpotLight",this.position.copy(xt.DEFAULT_UP),this.updateMatrix(),this.target=new xt,this.distance=n,this.angle=s,this.penumbra=r,this.decay=o,this.map=null,this.shadow=new vu}get power(){return this.intensity*Math.PI}set power(e){this.intensity=e/Math.PI}dispose(){super.dispose(),this.shadow.dispose()}copy(e,t){return super.copy(e,t),this.distance=e.distance,this.angle=e.angle,this.penumbra=e.penumbra,this.decay=e.decay,this.target=e.target.clone(),this.map=e.map,this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.distance=this.distance,t.object.angle=this.angle,t.object.decay=this.decay,t.object.penumbra=this.penumbra,t.object.target=this.target.uuid,this.map&&this.map.isTexture&&(t.object.map=this.map.toJSON(e).uuid),t.object.shadow=this.shadow.toJSON(),t}},_u=class extends Dr{constructor(){super(new Ut(90,1,.5,500)),this.isPointLightShadow=!0}},Ws=class extends Hs{constructor(e,t,n=0,s=2){super(e,t),this.isPointLight=!0,this.type="PointLight",this.distance=n,this.decay=s,this.shadow=new _u}get power(){return this.intensity*4*Math.PI}set power(e){this.intensity=e/(4*Math.PI)}dispose(){super.dispose(),this.shadow.dispose()}copy(e,t){return super.copy(e,t),this.distance=e.distance,this.decay=e.decay,this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.distance=this.distance,t.object.decay=this.decay,t.object.shadow=this.shadow.toJSON(),t}},Gi=class extends Oo{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},bu=class extends Dr{constructor(){super(new Gi(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Wi=class extends Hs{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(xt.DEFAULT_UP),this.updateMatrix(),this.target=new xt,this.shadow=new bu}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var Xi=class{static extractUrlBase(e){let t=e.lastIndexOf("/");return t===-1?"./":e.slice(0,t+1)}static resolveURL(e,t){return typeof e!="string"||e===""?"":(/^https?:\/\//i.test(t)&&/^\//.test(e)&&(t=t.replace(/(^https?:\/\/[^\/]+).*/i,"$1")),/^(https?:)?\/\//i.test(e)||/^data:.*,.*$/i.test(e)||/^blob:.*$/i.test(e)?e:t+e)}},Bo=class extends Je{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(e){return super.copy(e),this.instanceCount=e.instanceCount,this}toJSON(){let e=super.toJSON();return e.instanceCount=this.instanceCount,e.isInstancedBufferGeometry=!0,e}};var uu=new WeakMap,ko=class extends on{constructor(e){super(e),this.isImageBitmapLoader=!0,typeof createImageBitmap>"u"&&Re("ImageBitmapLoader: createImageBitmap() not supported."),typeof fetch>"u"&&Re("ImageBitmapLoader: fetch() not supported."),this.options={premultiplyAlpha:"none"},this._abortController=new AbortController}setOptions(e){return this.options=e,this}load(e,t,n,s){e===void 0&&(e=""),this.path!==void 0&&(e=this.path+e),e=this.manager.resolveURL(e);let r=this,o=gi.get(`image-bitmap:${e}`);if(o!==void 0){if(r.manager.itemStart(e),o.then){o.then(c=>{uu.has(o)===!0?(s&&s(uu.get(o)),r.manager.itemError(e),r.manager.itemEnd(e)):(t&&t(c),r.manager.itemEnd(e))});return}setTimeout(function(){t&&t(o),r.manager.itemEnd(e)},0);return}let a={};a.credentials=this.withCredentials||this.crossOrigin!=="anonymous"?"include":"same-origin",a.headers=this.requestHeader,a.priority=this.priority,a.cache=this.cache,a.signal=typeof AbortSignal.any=="function"?AbortSignal.any([this._abortController.signal,this.manager.abortController.signal]):this._abortController.signal;let l=fetch(e,a).then(function(c){return c.blob()}).then(function(c){return createImageBitmap(c,Object.assign({},r.options,{colorSpaceConversion:"none"}))}).then(function(c){return gi.add(`image-bitmap:${e}`,c),t&&t(c),r.manager.itemEnd(e),c}).catch(function(c){s&&s(c),uu.set(l,c),gi.remove(`image-bitmap:${e}`),r.manager.itemError(e),r.manager.itemEnd(e)});gi.add(`image-bitmap:${e}`,l),r.manager.itemStart(e)}abort(){return this._abortController.abort(),this._abortController=new AbortController,this}};var vr=-90,_r=1,Ur=class extends xt{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Ut(vr,_r,e,t);s.layers=this.layers,this.add(s);let r=new Ut(vr,_r,e,t);r.layers=this.layers,this.add(r);let o=new Ut(vr,_r,e,t);o.layers=this.layers,this.add(o);let a=new Ut(vr,_r,e,t);a.layers=this.layers,this.add(a);let l=new Ut(vr,_r,e,t);l.layers=this.layers,this.add(l);let c=new Ut(vr,_r,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===qn)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===wr)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),y=e.xr.enabled;e.xr.enabled=!1;let x=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let m=!1;e.isWebGLRenderer===!0?m=e.state.buffers.depth.getReversed():m=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=x,e.setRenderTarget(n,5,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=y,n.texture.needsPMREMUpdate=!0}},vl=class extends Ut{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var td="\\[\\]\\.:\\/",Kx=new RegExp("["+td+"]","g"),nd="[^"+td+"]",jx="[^"+td.replace("\\.","")+"]",Jx=/((?:WC+[\/:])*)/.source.replace("WC",nd),Zx=/(WCOD+)?/.source.replace("WCOD",jx),Qx=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",nd),ev=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",nd),tv=new RegExp("^"+Jx+Zx+Qx+ev+"$"),nv=["material","materials","bones","map"],Mu=class{constructor(e,t,n){let s=n||mt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},mt=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Kx,"")}static parseTrackName(e){let t=tv.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);nv.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Re("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){De("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){De("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){De("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){De("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){De("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){De("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){De("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;De("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){De("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){De("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};mt.Composite=Mu;mt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};mt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};mt.prototype.GetterByBindingType=[mt.prototype._getValue_direct,mt.prototype._getValue_array,mt.prototype._getValue_arrayElement,mt.prototype._getValue_toArray];mt.prototype.SetterByBindingTypeAndVersioning=[[mt.prototype._setValue_direct,mt.prototype._setValue_direct_setNeedsUpdate,mt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[mt.prototype._setValue_array,mt.prototype._setValue_array_setNeedsUpdate,mt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[mt.prototype._setValue_arrayElement,mt.prototype._setValue_arrayElement_setNeedsUpdate,mt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[mt.prototype._setValue_fromArray,mt.prototype._setValue_fromArray_setNeedsUpdate,mt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var AE=new Float32Array(1);var Gp=new ke,zo=class{constructor(e,t,n=0,s=1/0){this.ray=new yi(e,t),this.near=n,this.far=s,this.camera=null,this.layers=new Rr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):De("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return Gp.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(Gp),this}intersectObject(e,t=!0,n=[]){return Su(e,this,n,t),n.sort(Wp),n}intersectObjects(e,t=!0,n=[]){for(let s=0,r=e.length;s<r;s++)Su(e[s],this,n,t);return n.sort(Wp),n}};function Wp(i,e){return i.distance-e.distance}function Su(i,e,t,n){let s=!0;if(i.layers.test(e.layers)&&i.raycast(e,t)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)Su(r[o],e,t,!0)}}var Or=class{constructor(e=1,t=0,n=0){this.radius=e,this.phi=t,this.theta=n}set(e,t,n){return this.radius=e,this.phi=t,this.theta=n,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=Ye(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,n){return this.radius=Math.sqrt(e*e+t*t+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,n),this.phi=Math.acos(Ye(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var wu=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};var Vo=class extends oi{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function id(i,e,t,n){let s=iv(n);switch(t){case Hu:return i*e;case Tl:return i*e/s.components*s.byteLength;case El:return i*e/s.components*s.byteLength;case xs:return i*e*2/s.components*s.byteLength;case Rl:return i*e*2/s.components*s.byteLength;case Gu:return i*e*3/s.components*s.byteLength;case an:return i*e*4/s.components*s.byteLength;case Vr:return i*e*4/s.components*s.byteLength;case Xo:case qo:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case $o:case Yo:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Pl:case Ll:return Math.max(i,16)*Math.max(e,8)/4;case Cl:case Il:return Math.max(i,8)*Math.max(e,8)/2;case Nl:case Dl:case Ol:case Fl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Ul:case Ko:case Bl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case kl:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case zl:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Vl:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Hl:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Gl:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case Wl:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case Xl:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case ql:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case $l:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case Yl:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Kl:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case jl:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case Jl:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case Zl:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case Ql:case ec:case tc:return Math.ceil(i/4)*Math.ceil(e/4)*16;case nc:case ic:return Math.ceil(i/4)*Math.ceil(e/4)*8;case jo:case sc:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function iv(i){switch(i){case Rn:case Bu:return{byteLength:1,components:1};case zr:case ku:case hi:return{byteLength:2,components:1};case wl:case Al:return{byteLength:2,components:4};case Cn:case Sl:case Jt:return{byteLength:4,components:1};case zu:case Vu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Re("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Qm(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function rv(i){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,y)=>f.start-y.start);let d=0;for(let f=1;f<u.length;f++){let y=u[d],x=u[f];x.start<=y.start+y.count+1?y.count=Math.max(y.count,x.start+x.count-y.start):(++d,u[d]=x)}u.length=d+1;for(let f=0,y=u.length;f<y;f++){let x=u[f];i.bufferSubData(c,x.start*h.BYTES_PER_ELEMENT,h,x.start,x.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var ov=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,av=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,lv=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,cv=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,hv=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,uv=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,dv=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,fv=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,pv=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,mv=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,gv=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,yv=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,xv=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,vv=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,_v=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,bv=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Mv=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Sv=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,wv=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Av=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Tv=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Ev=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Rv=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Cv=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Pv=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Iv=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Lv=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Nv=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Dv=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Uv="gl_FragColor = linearToOutputTexel( gl_FragColor );",Ov=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Fv=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Bv=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,kv=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,zv=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Vv=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Hv=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Gv=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,Wv=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Xv=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,qv=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,$v=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Yv=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Kv=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,jv=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,Jv=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,Zv=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Qv=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,e_=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,t_=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,n_=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,i_=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,s_=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,r_=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,o_=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,a_=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,l_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,c_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,h_=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,u_=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,d_=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,f_=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,p_=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,m_=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,g_=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,y_=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,x_=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,v_=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,__=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,b_=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,M_=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,S_=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,w_=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,A_=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,T_=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,E_=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,R_=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,C_=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,P_=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,I_=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,L_=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,N_=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,D_=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,U_=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,O_=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,F_=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,B_=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,k_=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,z_=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,V_=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,H_=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,G_=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,W_=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,X_=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,q_=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,$_=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Y_=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,K_=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,j_=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,J_=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Z_=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Q_=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,eb=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,tb=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,nb=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,ib=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,sb=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,rb=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ob=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ab=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,lb=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,cb=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,hb=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ub=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,db=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,fb=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,pb=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,mb=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,gb=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,yb=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,xb=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,vb=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,_b=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,bb=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Mb=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Sb=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,wb=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ab=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Tb=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Eb=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Rb=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Cb=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Pb=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ib=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Lb=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Nb=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Db=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Ub=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ob=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Fb=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Bb=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,qe={alphahash_fragment:ov,alphahash_pars_fragment:av,alphamap_fragment:lv,alphamap_pars_fragment:cv,alphatest_fragment:hv,alphatest_pars_fragment:uv,aomap_fragment:dv,aomap_pars_fragment:fv,batching_pars_vertex:pv,batching_vertex:mv,begin_vertex:gv,beginnormal_vertex:yv,bsdfs:xv,iridescence_fragment:vv,bumpmap_pars_fragment:_v,clipping_planes_fragment:bv,clipping_planes_pars_fragment:Mv,clipping_planes_pars_vertex:Sv,clipping_planes_vertex:wv,color_fragment:Av,color_pars_fragment:Tv,color_pars_vertex:Ev,color_vertex:Rv,common:Cv,defaultnormal_vertex:Pv,displacementmap_pars_vertex:Iv,displacementmap_vertex:Lv,emissivemap_fragment:Nv,emissivemap_pars_fragment:Dv,colorspace_fragment:Uv,colorspace_pars_fragment:Ov,envmap_fragment:Fv,envmap_common_pars_fragment:Bv,envmap_pars_fragment:kv,envmap_pars_vertex:zv,envmap_physical_pars_fragment:Jv,envmap_vertex:Vv,fog_vertex:Hv,fog_pars_vertex:Gv,fog_fragment:Wv,fog_pars_fragment:Xv,gradientmap_pars_fragment:qv,lightmap_pars_fragment:$v,lights_lambert_fragment:Yv,lights_lambert_pars_fragment:Kv,lights_pars_begin:jv,lights_toon_fragment:Zv,lights_toon_pars_fragment:Qv,lights_phong_fragment:e_,lights_phong_pars_fragment:t_,lights_physical_fragment:n_,lights_physical_pars_fragment:i_,lights_fragment_begin:s_,lights_fragment_maps:r_,lights_fragment_end:o_,lightprobes_pars_fragment:a_,logdepthbuf_fragment:l_,logdepthbuf_pars_fragment:c_,logdepthbuf_pars_vertex:h_,logdepthbuf_vertex:u_,map_fragment:d_,map_pars_fragment:f_,map_particle_fragment:p_,map_particle_pars_fragment:m_,metalnessmap_fragment:g_,metalnessmap_pars_fragment:y_,morphinstance_vertex:x_,morphcolor_vertex:v_,morphnormal_vertex:__,morphtarget_pars_vertex:b_,morphtarget_vertex:M_,normal_fragment_begin:S_,normal_fragment_maps:w_,normal_pars_fragment:A_,normal_pars_vertex:T_,normal_vertex:E_,normalmap_pars_fragment:R_,clearcoat_normal_fragment_begin:C_,clearcoat_normal_fragment_maps:P_,clearcoat_pars_fragment:I_,iridescence_pars_fragment:L_,opaque_fragment:N_,packing:D_,premultiplied_alpha_fragment:U_,project_vertex:O_,dithering_fragment:F_,dithering_pars_fragment:B_,roughnessmap_fragment:k_,roughnessmap_pars_fragment:z_,shadowmap_pars_fragment:V_,shadowmap_pars_vertex:H_,shadowmap_vertex:G_,shadowmask_pars_fragment:W_,skinbase_vertex:X_,skinning_pars_vertex:q_,skinning_vertex:$_,skinnormal_vertex:Y_,specularmap_fragment:K_,specularmap_pars_fragment:j_,tonemapping_fragment:J_,tonemapping_pars_fragment:Z_,transmission_fragment:Q_,transmission_pars_fragment:eb,uv_pars_fragment:tb,uv_pars_vertex:nb,uv_vertex:ib,worldpos_vertex:sb,background_vert:rb,background_frag:ob,backgroundCube_vert:ab,backgroundCube_frag:lb,cube_vert:cb,cube_frag:hb,depth_vert:ub,depth_frag:db,distance_vert:fb,distance_frag:pb,equirect_vert:mb,equirect_frag:gb,linedashed_vert:yb,linedashed_frag:xb,meshbasic_vert:vb,meshbasic_frag:_b,meshlambert_vert:bb,meshlambert_frag:Mb,meshmatcap_vert:Sb,meshmatcap_frag:wb,meshnormal_vert:Ab,meshnormal_frag:Tb,meshphong_vert:Eb,meshphong_frag:Rb,meshphysical_vert:Cb,meshphysical_frag:Pb,meshtoon_vert:Ib,meshtoon_frag:Lb,points_vert:Nb,points_frag:Db,shadow_vert:Ub,shadow_frag:Ob,sprite_vert:Fb,sprite_frag:Bb},ye={common:{diffuse:{value:new be(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ue},alphaMap:{value:null},alphaMapTransform:{value:new Ue},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ue}},envmap:{envMap:{value:null},envMapRotation:{value:new Ue},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ue}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ue}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ue},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ue},normalScale:{value:new Ee(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ue},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ue}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ue}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ue}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new be(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new be(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ue},alphaTest:{value:0},uvTransform:{value:new Ue}},sprite:{diffuse:{value:new be(16777215)},opacity:{value:1},center:{value:new Ee(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ue},alphaMap:{value:null},alphaMapTransform:{value:new Ue},alphaTest:{value:0}}},Si={basic:{uniforms:ln([ye.common,ye.specularmap,ye.envmap,ye.aomap,ye.lightmap,ye.fog]),vertexShader:qe.meshbasic_vert,fragmentShader:qe.meshbasic_frag},lambert:{uniforms:ln([ye.common,ye.specularmap,ye.envmap,ye.aomap,ye.lightmap,ye.emissivemap,ye.bumpmap,ye.normalmap,ye.displacementmap,ye.fog,ye.lights,{emissive:{value:new be(0)},envMapIntensity:{value:1}}]),vertexShader:qe.meshlambert_vert,fragmentShader:qe.meshlambert_frag},phong:{uniforms:ln([ye.common,ye.specularmap,ye.envmap,ye.aomap,ye.lightmap,ye.emissivemap,ye.bumpmap,ye.normalmap,ye.displacementmap,ye.fog,ye.lights,{emissive:{value:new be(0)},specular:{value:new be(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:qe.meshphong_vert,fragmentShader:qe.meshphong_frag},standard:{uniforms:ln([ye.common,ye.envmap,ye.aomap,ye.lightmap,ye.emissivemap,ye.bumpmap,ye.normalmap,ye.displacementmap,ye.roughnessmap,ye.metalnessmap,ye.fog,ye.lights,{emissive:{value:new be(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:qe.meshphysical_vert,fragmentShader:qe.meshphysical_frag},toon:{uniforms:ln([ye.common,ye.aomap,ye.lightmap,ye.emissivemap,ye.bumpmap,ye.normalmap,ye.displacementmap,ye.gradientmap,ye.fog,ye.lights,{emissive:{value:new be(0)}}]),vertexShader:qe.meshtoon_vert,fragmentShader:qe.meshtoon_frag},matcap:{uniforms:ln([ye.common,ye.bumpmap,ye.normalmap,ye.displacementmap,ye.fog,{matcap:{value:null}}]),vertexShader:qe.meshmatcap_vert,fragmentShader:qe.meshmatcap_frag},points:{uniforms:ln([ye.points,ye.fog]),vertexShader:qe.points_vert,fragmentShader:qe.points_frag},dashed:{uniforms:ln([ye.common,ye.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:qe.linedashed_vert,fragmentShader:qe.linedashed_frag},depth:{uniforms:ln([ye.common,ye.displacementmap]),vertexShader:qe.depth_vert,fragmentShader:qe.depth_frag},normal:{uniforms:ln([ye.common,ye.bumpmap,ye.normalmap,ye.displacementmap,{opacity:{value:1}}]),vertexShader:qe.meshnormal_vert,fragmentShader:qe.meshnormal_frag},sprite:{uniforms:ln([ye.sprite,ye.fog]),vertexShader:qe.sprite_vert,fragmentShader:qe.sprite_frag},background:{uniforms:{uvTransform:{value:new Ue},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:qe.background_vert,fragmentShader:qe.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ue}},vertexShader:qe.backgroundCube_vert,fragmentShader:qe.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:qe.cube_vert,fragmentShader:qe.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:qe.equirect_vert,fragmentShader:qe.equirect_frag},distance:{uniforms:ln([ye.common,ye.displacementmap,{referencePosition:{value:new U},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:qe.distance_vert,fragmentShader:qe.distance_frag},shadow:{uniforms:ln([ye.lights,ye.fog,{color:{value:new be(0)},opacity:{value:1}}]),vertexShader:qe.shadow_vert,fragmentShader:qe.shadow_frag}};Si.physical={uniforms:ln([Si.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ue},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ue},clearcoatNormalScale:{value:new Ee(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ue},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ue},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ue},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ue},sheen:{value:0},sheenColor:{value:new be(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ue},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ue},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ue},transmissionSamplerSize:{value:new Ee},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ue},attenuationDistance:{value:0},attenuationColor:{value:new be(0)},specularColor:{value:new be(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ue},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ue},anisotropyVector:{value:new Ee},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ue}}]),vertexShader:qe.meshphysical_vert,fragmentShader:qe.meshphysical_frag};var oc={r:0,b:0,g:0},kb=new ke,eg=new Ue;eg.set(-1,0,0,0,1,0,0,0,1);function zb(i,e,t,n,s,r){let o=new be(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(S){let M=S.isScene===!0?S.background:null;if(M&&M.isTexture){let _=S.backgroundBlurriness>0;M=e.get(M,_)}return M}function y(S){let M=!1,_=f(S);_===null?m(o,a):_&&_.isColor&&(m(_,1),M=!0);let T=i.xr.getEnvironmentBlendMode();T==="additive"?t.buffers.color.setClear(0,0,0,1,r):T==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||M)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function x(S,M){let _=f(M);_&&_.isCubeTexture?(c===void 0&&(c=new je(new ds(1,1,1),new An({name:"BackgroundCubeMaterial",uniforms:js(Si.backgroundCube.uniforms),vertexShader:Si.backgroundCube.vertexShader,fragmentShader:Si.backgroundCube.fragmentShader,side:jt,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(T,w,p){this.matrixWorld.copyPosition(p.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=_,c.material.uniforms.backgroundBlurriness.value=M.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=M.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(kb.makeRotationFromEuler(M.backgroundRotation)).transpose(),_.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(eg),c.material.toneMapped=$e.getTransfer(_.colorSpace)!==lt,(h!==_||u!==_.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=_,u=_.version,d=i.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null)):_&&_.isTexture&&(l===void 0&&(l=new je(new fs(2,2),new An({name:"BackgroundMaterial",uniforms:js(Si.background.uniforms),vertexShader:Si.background.vertexShader,fragmentShader:Si.background.fragmentShader,side:vi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=_,l.material.uniforms.backgroundIntensity.value=M.backgroundIntensity,l.material.toneMapped=$e.getTransfer(_.colorSpace)!==lt,_.matrixAutoUpdate===!0&&_.updateMatrix(),l.material.uniforms.uvTransform.value.copy(_.matrix),(h!==_||u!==_.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=_,u=_.version,d=i.toneMapping),l.layers.enableAll(),S.unshift(l,l.geometry,l.material,0,0,null))}function m(S,M){S.getRGB(oc,ed(i)),t.buffers.color.setClear(oc.r,oc.g,oc.b,M,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(S,M=1){o.set(S),a=M,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(S){a=S,m(o,a)},render:y,addToRenderList:x,dispose:g}}function Vb(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(I,D,B,P,G){let W=!1,k=u(I,P,B,D);r!==k&&(r=k,c(r.object)),W=f(I,P,B,G),W&&y(I,P,B,G),G!==null&&e.update(G,i.ELEMENT_ARRAY_BUFFER),(W||o)&&(o=!1,_(I,D,B,P),G!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(G).buffer))}function l(){return i.createVertexArray()}function c(I){return i.bindVertexArray(I)}function h(I){return i.deleteVertexArray(I)}function u(I,D,B,P){let G=P.wireframe===!0,W=n[D.id];W===void 0&&(W={},n[D.id]=W);let k=I.isInstancedMesh===!0?I.id:0,Q=W[k];Q===void 0&&(Q={},W[k]=Q);let q=Q[B.id];q===void 0&&(q={},Q[B.id]=q);let ee=q[G];return ee===void 0&&(ee=d(l()),q[G]=ee),ee}function d(I){let D=[],B=[],P=[];for(let G=0;G<t;G++)D[G]=0,B[G]=0,P[G]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:D,enabledAttributes:B,attributeDivisors:P,object:I,attributes:{},index:null}}function f(I,D,B,P){let G=r.attributes,W=D.attributes,k=0,Q=B.getAttributes();for(let q in Q)if(Q[q].location>=0){let te=G[q],_e=W[q];if(_e===void 0&&(q==="instanceMatrix"&&I.instanceMatrix&&(_e=I.instanceMatrix),q==="instanceColor"&&I.instanceColor&&(_e=I.instanceColor)),te===void 0||te.attribute!==_e||_e&&te.data!==_e.data)return!0;k++}return r.attributesNum!==k||r.index!==P}function y(I,D,B,P){let G={},W=D.attributes,k=0,Q=B.getAttributes();for(let q in Q)if(Q[q].location>=0){let te=W[q];te===void 0&&(q==="instanceMatrix"&&I.instanceMatrix&&(te=I.instanceMatrix),q==="instanceColor"&&I.instanceColor&&(te=I.instanceColor));let _e={};_e.attribute=te,te&&te.data&&(_e.data=te.data),G[q]=_e,k++}r.attributes=G,r.attributesNum=k,r.index=P}function x(){let I=r.newAttributes;for(let D=0,B=I.length;D<B;D++)I[D]=0}function m(I){g(I,0)}function g(I,D){let B=r.newAttributes,P=r.enabledAttributes,G=r.attributeDivisors;B[I]=1,P[I]===0&&(i.enableVertexAttribArray(I),P[I]=1),G[I]!==D&&(i.vertexAttribDivisor(I,D),G[I]=D)}function S(){let I=r.newAttributes,D=r.enabledAttributes;for(let B=0,P=D.length;B<P;B++)D[B]!==I[B]&&(i.disableVertexAttribArray(B),D[B]=0)}function M(I,D,B,P,G,W,k){k===!0?i.vertexAttribIPointer(I,D,B,G,W):i.vertexAttribPointer(I,D,B,P,G,W)}function _(I,D,B,P){x();let G=P.attributes,W=B.getAttributes(),k=D.defaultAttributeValues;for(let Q in W){let q=W[Q];if(q.location>=0){let ee=G[Q];if(ee===void 0&&(Q==="instanceMatrix"&&I.instanceMatrix&&(ee=I.instanceMatrix),Q==="instanceColor"&&I.instanceColor&&(ee=I.instanceColor)),ee!==void 0){let te=ee.normalized,_e=ee.itemSize,Ae=e.get(ee);if(Ae===void 0)continue;let Y=Ae.buffer,re=Ae.type,ve=Ae.bytesPerElement,Pe=re===i.INT||re===i.UNSIGNED_INT||ee.gpuType===Sl;if(ee.isInterleavedBufferAttribute){let me=ee.data,Oe=me.isInterleavedBuffer===!0?me.stride:me.itemSize,St=ee.offset;if(me.isInstancedInterleavedBuffer||me.isInstancedBufferAttribute){for(let Le=0;Le<q.locationSize;Le++)g(q.location+Le,me.meshPerAttribute);I.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=me.meshPerAttribute*me.count)}else for(let Le=0;Le<q.locationSize;Le++)m(q.location+Le);i.bindBuffer(i.ARRAY_BUFFER,Y);for(let Le=0;Le<q.locationSize;Le++)M(q.location+Le,_e/q.locationSize,re,te,Oe*ve,(St+_e/q.locationSize*Le)*ve,Pe)}else{if(ee.isInstancedBufferAttribute){for(let me=0;me<q.locationSize;me++)g(q.location+me,ee.meshPerAttribute);I.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=ee.meshPerAttribute*ee.count)}else for(let me=0;me<q.locationSize;me++)m(q.location+me);i.bindBuffer(i.ARRAY_BUFFER,Y);for(let me=0;me<q.locationSize;me++)M(q.location+me,_e/q.locationSize,re,te,_e*ve,_e/q.locationSize*me*ve,Pe)}}else if(k!==void 0){let te=k[Q];if(te!==void 0)switch(te.length){case 2:i.vertexAttrib2fv(q.location,te);break;case 3:i.vertexAttrib3fv(q.location,te);break;case 4:i.vertexAttrib4fv(q.location,te);break;default:i.vertexAttrib1fv(q.location,te)}}}}S()}function T(){C();for(let I in n){let D=n[I];for(let B in D){let P=D[B];for(let G in P){let W=P[G];for(let k in W)h(W[k].object),delete W[k];delete P[G]}}delete n[I]}}function w(I){if(n[I.id]===void 0)return;let D=n[I.id];for(let B in D){let P=D[B];for(let G in P){let W=P[G];for(let k in W)h(W[k].object),delete W[k];delete P[G]}}delete n[I.id]}function p(I){for(let D in n){let B=n[D];for(let P in B){let G=B[P];if(G[I.id]===void 0)continue;let W=G[I.id];for(let k in W)h(W[k].object),delete W[k];delete G[I.id]}}}function v(I){for(let D in n){let B=n[D],P=I.isInstancedMesh===!0?I.id:0,G=B[P];if(G!==void 0){for(let W in G){let k=G[W];for(let Q in k)h(k[Q].object),delete k[Q];delete G[W]}delete B[P],Object.keys(B).length===0&&delete n[D]}}}function C(){R(),o=!0,r!==s&&(r=s,c(r.object))}function R(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:C,resetDefaultState:R,dispose:T,releaseStatesOfGeometry:w,releaseStatesOfObject:v,releaseStatesOfProgram:p,initAttributes:x,enableAttribute:m,disableUnusedAttributes:S}}function Hb(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Gb(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let p=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(p.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(p){return!(p!==an&&n.convert(p)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(p){let v=p===hi&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(p!==Rn&&p!==Jt&&!v&&n.convert(p)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(p){if(p==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";p="mediump"}return p==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(Re("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Re("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Re("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),y=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),S=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),M=i.getParameter(i.MAX_VARYING_VECTORS),_=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),T=i.getParameter(i.MAX_SAMPLES),w=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:y,maxTextureSize:x,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:S,maxVaryings:M,maxFragmentUniforms:_,maxSamples:T,samples:w}}function Wb(i){let e=this,t=null,n=0,s=!1,r=!1,o=new Un,a=new Ue,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let y=u.clippingPlanes,x=u.clipIntersection,m=u.clipShadows,g=i.get(u);if(!s||y===null||y.length===0||r&&!m)r?h(null):c();else{let S=r?0:n,M=S*4,_=g.clippingState||null;l.value=_,_=h(y,d,M,f);for(let T=0;T!==M;++T)_[T]=t[T];g.clippingState=_,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(u,d,f,y){let x=u!==null?u.length:0,m=null;if(x!==0){if(m=l.value,y!==!0||m===null){let g=f+x*4,S=d.matrixWorldInverse;a.getNormalMatrix(S),(m===null||m.length<g)&&(m=new Float32Array(g));for(let M=0,_=f;M!==x;++M,_+=4)o.copy(u[M]).applyMatrix4(S,a),o.normal.toArray(m,_),m[_+3]=o.constant}l.value=m,l.needsUpdate=!0}return e.numPlanes=x,e.numIntersection=0,m}}var ea=class extends mn{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new Ro(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new ds(5,5,5),r=new An({name:"CubemapFromEquirect",uniforms:js(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:jt,blending:ci});r.uniforms.tEquirect.value=t;let o=new je(s,r),a=t.minFilter;return t.minFilter===Kn&&(t.minFilter=Ot),new Ur(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},Lm=256,Xb=3,qb=20,tg=256,ng=16,$b=3,Yb=new U,Kb=new be,qr=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Ur(1,10,null),this._boxMesh=new je(new ds(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=Yb}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,y=l.autoClearStencil,x=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,x===null&&(e.background=l.getClearColor(Kb));let m=new Ur(n,s,h);return m.position.copy(a),m.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=y,e.background=x,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Um(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Dm(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(Lm,Ju(e))}_fromTexture(e,t){e.mapping===qs||e.mapping===Br?this._setSize(e.image.length===0?Lm:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=Nm(e,!1,!1),n=Math.log2(e)-Xb;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=Nm(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===qs||e.mapping===Br?(this._cubemapMaterial===null&&(this._cubemapMaterial=Um()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Dm()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=jb(),this._integrationMaterial=Jb());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/ng);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-$b)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(tg*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=Zb());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function Nm(i,e,t){return new ea(i,{minFilter:Kn,generateMipmaps:e,type:hi,colorSpace:pn,depthBuffer:t})}function ta(i,e,t){return new An({name:i,uniforms:e,vertexShader:qe.cube_vert,fragmentShader:t,side:jt,blending:ci,depthTest:!1,depthWrite:!1})}function jb(){return ta("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${tg}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Jb(){return ta("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:ng}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Zb(){return ta("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${qb}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Dm(){return ta("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Um(){return ta("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Qb(i){let e=new WeakMap,t=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===_l||f===bl)if(e.has(d)){let y=e.get(d).texture;return a(y,d.mapping)}else{let y=d.image;if(y&&y.height>0){let x=new ea(y.height);return x.fromEquirectangularTexture(i,d),e.set(d,x),d.addEventListener("dispose",c),a(x.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,y=f===_l||f===bl,x=f===qs||f===Br;if(y||x){let m=t.get(d),g=m!==void 0?m.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return n===null&&(n=new qr(i)),m=y?n.fromEquirectangular(d,m):n.fromCubemap(d,m),m.texture.pmremVersion=d.pmremVersion,t.set(d,m),m.texture;if(m!==void 0)return m.texture;{let S=d.image;return y&&S&&S.height>0||x&&S&&l(S)?(n===null&&(n=new qr(i)),m=y?n.fromEquirectangular(d):n.fromCubemap(d),m.texture.pmremVersion=d.pmremVersion,t.set(d,m),d.addEventListener("dispose",h),m.texture):null}}}return d}function a(d,f){return f===_l?d.mapping=qs:f===bl&&(d.mapping=Br),d}function l(d){let f=0,y=6;for(let x=0;x<y;x++)d[x]!==void 0&&f++;return f===y}function c(d){let f=d.target;f.removeEventListener("dispose",c);let y=e.get(f);y!==void 0&&(e.delete(f),y.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let y=t.get(f);y!==void 0&&(t.delete(f),y.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function eM(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&Ns("WebGLRenderer: "+n+" extension not supported."),s}}}function tM(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(y=>delete s[y]);function a(y){l(y.target)}function l(y){y.index!==null&&e.remove(y.index);for(let m in y.attributes)e.remove(y.attributes[m]);y.removeEventListener("dispose",a),delete s[y.id],o.unregister(y);let x=r.get(y);x&&(e.remove(x),r.delete(y)),n.releaseStatesOfGeometry(y),y.isInstancedBufferGeometry===!0&&delete y._maxInstanceCount,t.memory.geometries--}function c(y,x){return s[x.id]!==void 0||(x.addEventListener("dispose",a),s[x.id]=new WeakRef(x),o.register(x,x.id,x),t.memory.geometries++),x}function h(y){let x=y.attributes;for(let m in x)e.update(x[m],i.ARRAY_BUFFER)}function u(y){let x=y.index,m=y.attributes.position,g=0;if(m===void 0)return;let S=x!==null?x.array.length:m.array.length/3-1,M=m.count>=65535?ks:Bs,_=new M(Math.ceil(S/3)*6,1),T=_.array;if(x!==null){let p=x.array;g=x.version;for(let v=0,C=0;v<S;v+=3){let R=p[v+0],I=p[v+1],D=p[v+2];T[C++]=R,T[C++]=I,T[C++]=I,T[C++]=D,T[C++]=D,T[C++]=R}}else{g=m.version;for(let p=0,v=0;p<S;p+=3){let C=p+0,R=p+1,I=p+2;T[v++]=C,T[v++]=R,T[v++]=R,T[v++]=I,T[v++]=I,T[v++]=C}}_.version=g;let w=r.get(y);w&&e.remove(w),r.set(y,_)}function d(y){let x=r.get(y);if(x){let m=y.index;m!==null&&x.version<m.version&&u(y)}else u(y);return r.get(y)}function f(){for(let y in s){let x=s[y].deref();x!==void 0&&l(x)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function nM(i,e,t){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),t.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),t.update(d,n,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let x=0;for(let m=0;m<f;m++)x+=d[m];t.update(x,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function iM(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:De("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function sM(i,e,t){let n=new WeakMap,s=new it;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let C=function(){p.dispose(),n.delete(a),a.removeEventListener("dispose",C)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,y=a.morphAttributes.normal!==void 0,x=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],S=a.morphAttributes.color||[],M=0;f===!0&&(M=1),y===!0&&(M=2),x===!0&&(M=3);let _=a.attributes.position.count*M,T=1;_>e.maxTextureSize&&(T=Math.ceil(_/e.maxTextureSize),_=e.maxTextureSize);let w=new Float32Array(_*T*4*u),p=new bo(w,_,T,u);p.type=Jt,p.needsUpdate=!0;let v=M*4;for(let R=0;R<u;R++){let I=m[R],D=g[R],B=S[R],P=_*T*4*R;for(let G=0;G<I.count;G++){let W=G*v;f===!0&&(s.fromBufferAttribute(I,G),w[P+W+0]=s.x,w[P+W+1]=s.y,w[P+W+2]=s.z,w[P+W+3]=0),y===!0&&(s.fromBufferAttribute(D,G),w[P+W+4]=s.x,w[P+W+5]=s.y,w[P+W+6]=s.z,w[P+W+7]=0),x===!0&&(s.fromBufferAttribute(B,G),w[P+W+8]=s.x,w[P+W+9]=s.y,w[P+W+10]=s.z,w[P+W+11]=B.itemSize===4?s.w:1)}}d={count:u,texture:p,size:new Ee(_,T)},n.set(a,d),a.addEventListener("dispose",C)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let f=0;for(let x=0;x<c.length;x++)f+=c[x];let y=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",y),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function rM(i,e,t,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var oM={[Iu]:"LINEAR_TONE_MAPPING",[Lu]:"REINHARD_TONE_MAPPING",[Nu]:"CINEON_TONE_MAPPING",[Du]:"ACES_FILMIC_TONE_MAPPING",[Ou]:"AGX_TONE_MAPPING",[Wo]:"NEUTRAL_TONE_MAPPING",[Uu]:"CUSTOM_TONE_MAPPING"};function aM(i,e,t,n,s,r){let o=new mn(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Je;h.setAttribute("position",new gt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new gt([0,2,0,0,2,0],2));let u=new hl({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new je(h,u),f=new Gi(-1,1,1,-1,0,1),y=null,x=null,m=!1,g,S=null,M=[],_=!1;this.setSize=function(T,w){o.setSize(T,w),a!==null&&a.setSize(T,w),l!==null&&l.setSize(T,w);for(let p=0;p<M.length;p++){let v=M[p];v.setSize&&v.setSize(T,w)}},this.setEffects=function(T){M=T,_=M.length>0&&M[0].isRenderPass===!0;let w=o.width,p=o.height;M.length>0&&a===null&&(a=new mn(w,p,{type:hi,depthBuffer:!1,stencilBuffer:!1}),l=new mn(w,p,{type:hi,depthBuffer:!1,stencilBuffer:!1}));let v=s===!0&&M.some(C=>C.needsDepthTexture===!0);v!==(o.depthTexture!==null)&&(v===!0&&c===null&&(c=new Fi(w,p),r===!0&&(c.format=qi,c.type=Ys)),o.dispose(),o.depthTexture=v?c:null,o.resolveDepthBuffer=v,o.storeMultisampledDepthBuffer=v);for(let C=0;C<M.length;C++){let R=M[C];R.setSize&&R.setSize(w,p),v&&R.needsDepthTexture===!0&&R.setDepthTexture&&R.setDepthTexture(c)}},this.begin=function(T,w){if(m||T.toneMapping===_i&&M.length===0)return!1;if(S=w,w!==null){let p=w.width,v=w.height;(o.width!==p||o.height!==v)&&this.setSize(p,v)}return _===!1&&T.setRenderTarget(o),g=T.toneMapping,T.toneMapping=_i,!0},this.hasRenderPass=function(){return _},this.end=function(T,w){T.toneMapping=g,m=!0;let p=o,v=a;for(let C=0;C<M.length;C++){let R=M[C];R.enabled!==!1&&(R.render(T,v,p,w),R.needsSwap!==!1&&(p=v,v=v===a?l:a))}if(y!==T.outputColorSpace||x!==T.toneMapping){y=T.outputColorSpace,x=T.toneMapping,u.defines={},$e.getTransfer(y)===lt&&(u.defines.SRGB_TRANSFER="");let C=oM[x];C&&(u.defines[C]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=p.texture,T.setRenderTarget(S),T.render(d,f),S=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var ig=new Ft,sg=new Fi(1,1),rg=new Po(1),og=new bo,ag=new ol,lg=new Ro,Om=[],Fm=[],Bm=new Float32Array(16),km=new Float32Array(9),zm=new Float32Array(4);function Yr(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=Om[s];if(r===void 0&&(r=new Float32Array(s),Om[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function kt(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function zt(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function lc(i,e){let t=Fm[e];t===void 0&&(t=new Int32Array(e),Fm[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function lM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function cM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(kt(t,e))return;i.uniform2fv(this.addr,e),zt(t,e)}}function hM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(kt(t,e))return;i.uniform3fv(this.addr,e),zt(t,e)}}function uM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(kt(t,e))return;i.uniform4fv(this.addr,e),zt(t,e)}}function dM(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(kt(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),zt(t,e)}else{if(kt(t,n))return;zm.set(n),i.uniformMatrix2fv(this.addr,!1,zm),zt(t,n)}}function fM(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(kt(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),zt(t,e)}else{if(kt(t,n))return;km.set(n),i.uniformMatrix3fv(this.addr,!1,km),zt(t,n)}}function pM(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(kt(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),zt(t,e)}else{if(kt(t,n))return;Bm.set(n),i.uniformMatrix4fv(this.addr,!1,Bm),zt(t,n)}}function mM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function gM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(kt(t,e))return;i.uniform2iv(this.addr,e),zt(t,e)}}function yM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(kt(t,e))return;i.uniform3iv(this.addr,e),zt(t,e)}}function xM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(kt(t,e))return;i.uniform4iv(this.addr,e),zt(t,e)}}function vM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function _M(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(kt(t,e))return;i.uniform2uiv(this.addr,e),zt(t,e)}}function bM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(kt(t,e))return;i.uniform3uiv(this.addr,e),zt(t,e)}}function MM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(kt(t,e))return;i.uniform4uiv(this.addr,e),zt(t,e)}}function cc(i){return i.version===0&&(i.compareFunction=$u,i.needsUpdate=!0),i}function SM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=cc(sg):r=ig,t.setTexture2D(e||r,s)}function wM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||ag,s)}function AM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=cc(rg):r=lg,t.setTextureCube(e||r,s)}function TM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||og,s)}function EM(i){switch(i){case 5126:return lM;case 35664:return cM;case 35665:return hM;case 35666:return uM;case 35674:return dM;case 35675:return fM;case 35676:return pM;case 5124:case 35670:return mM;case 35667:case 35671:return gM;case 35668:case 35672:return yM;case 35669:case 35673:return xM;case 5125:return vM;case 36294:return _M;case 36295:return bM;case 36296:return MM;case 35678:case 36198:case 36298:case 36306:case 35682:return SM;case 35679:case 36299:case 36307:return wM;case 35680:case 36300:case 36308:case 36293:return AM;case 36289:case 36303:case 36311:case 36292:return TM}}function RM(i,e){i.uniform1fv(this.addr,e)}function CM(i,e){let t=Yr(e,this.size,2);i.uniform2fv(this.addr,t)}function PM(i,e){let t=Yr(e,this.size,3);i.uniform3fv(this.addr,t)}function IM(i,e){let t=Yr(e,this.size,4);i.uniform4fv(this.addr,t)}function LM(i,e){let t=Yr(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function NM(i,e){let t=Yr(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function DM(i,e){let t=Yr(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function UM(i,e){i.uniform1iv(this.addr,e)}function OM(i,e){i.uniform2iv(this.addr,e)}function FM(i,e){i.uniform3iv(this.addr,e)}function BM(i,e){i.uniform4iv(this.addr,e)}function kM(i,e){i.uniform1uiv(this.addr,e)}function zM(i,e){i.uniform2uiv(this.addr,e)}function VM(i,e){i.uniform3uiv(this.addr,e)}function HM(i,e){i.uniform4uiv(this.addr,e)}function GM(i,e,t){let n=this.cache,s=e.length,r=lc(t,s);kt(n,r)||(i.uniform1iv(this.addr,r),zt(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=cc(sg):o=ig;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function WM(i,e,t){let n=this.cache,s=e.length,r=lc(t,s);kt(n,r)||(i.uniform1iv(this.addr,r),zt(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||ag,r[o])}function XM(i,e,t){let n=this.cache,s=e.length,r=lc(t,s);kt(n,r)||(i.uniform1iv(this.addr,r),zt(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=cc(rg):o=lg;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function qM(i,e,t){let n=this.cache,s=e.length,r=lc(t,s);kt(n,r)||(i.uniform1iv(this.addr,r),zt(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||og,r[o])}function $M(i){switch(i){case 5126:return RM;case 35664:return CM;case 35665:return PM;case 35666:return IM;case 35674:return LM;case 35675:return NM;case 35676:return DM;case 5124:case 35670:return UM;case 35667:case 35671:return OM;case 35668:case 35672:return FM;case 35669:case 35673:return BM;case 5125:return kM;case 36294:return zM;case 36295:return VM;case 36296:return HM;case 35678:case 36198:case 36298:case 36306:case 35682:return GM;case 35679:case 36299:case 36307:return WM;case 35680:case 36300:case 36308:case 36293:return XM;case 36289:case 36303:case 36311:case 36292:return qM}}var od=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=EM(t.type)}},ad=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=$M(t.type)}},ld=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},sd=/(\w+)(\])?(\[|\.)?/g;function Vm(i,e){i.seq.push(e),i.map[e.id]=e}function YM(i,e,t){let n=i.name,s=n.length;for(sd.lastIndex=0;;){let r=sd.exec(n),o=sd.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){Vm(t,c===void 0?new od(a,i,e):new ad(a,i,e));break}else{let u=t.map[a];u===void 0&&(u=new ld(a),Vm(t,u)),t=u}}}var Xr=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);YM(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function Hm(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var KM=37297,jM=0;function JM(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var Gm=new Ue;function ZM(i){$e._getMatrix(Gm,$e.workingColorSpace,i);let e=`mat3( ${Gm.elements.map(t=>t.toFixed(4))} )`;switch($e.getTransfer(i)){case vo:return[e,"LinearTransferOETF"];case lt:return[e,"sRGBTransferOETF"];default:return Re("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function Wm(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+JM(i.getShaderSource(e),a)}else return r}function QM(i,e){let t=ZM(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var eS={[Iu]:"Linear",[Lu]:"Reinhard",[Nu]:"Cineon",[Du]:"ACESFilmic",[Ou]:"AgX",[Wo]:"Neutral",[Uu]:"Custom"};function tS(i,e){let t=eS[e];return t===void 0?(Re("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var ac=new U;function nS(){$e.getLuminanceCoefficients(ac);let i=ac.x.toFixed(4),e=ac.y.toFixed(4),t=ac.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function iS(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Qo).join(`
`)}function sS(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function rS(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function Qo(i){return i!==""}function Xm(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function qm(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var oS=/^[ \t]*#include +<([\w\d./]+)>/gm;function cd(i){return i.replace(oS,aS)}function aS(i,e){let t=qe[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return cd(t)}var lS=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function $m(i){return i.replace(lS,cS)}function cS(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Ym(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var hS={[Ho]:"SHADOWMAP_TYPE_PCF",[Fr]:"SHADOWMAP_TYPE_VSM"};function uS(i){return hS[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var dS={[Br]:"ENVMAP_MODE_REFRACTION"};function fS(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":dS[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var pS={[Go]:"ENVMAP_BLENDING_MULTIPLY",[dm]:"ENVMAP_BLENDING_MIX",[fm]:"ENVMAP_BLENDING_ADD"};function mS(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":pS[i.combine]||"ENVMAP_BLENDING_NONE"}function gS(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=uS(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=fS(t),u=mS(t),d=iS(t),f=sS(r),y=s.createProgram(),x,m,g=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(x=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Qo).join(`
`),x.length>0&&(x+=`
`),m=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Qo).join(`
`),m.length>0&&(m+=`
`)):(x=[Ym(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Qo).join(`
`),m=[Ym(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==_i?"#define TONE_MAPPING":"",t.toneMapping!==_i?qe.tonemapping_pars_fragment:"",t.toneMapping!==_i?tS("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",qe.colorspace_pars_fragment,QM("linearToOutputTexel",t.outputColorSpace),nS(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Qo).join(`
`)),o=cd(o),o=Xm(o,t),o=qm(o,t),a=cd(a),a=Xm(a,t),a=qm(a,t),o=$m(o),a=$m(a),t.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,x=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,m=["#define varying in",t.glslVersion===Ks?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Ks?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let S=g+x+o,M=g+m+a,_=Hm(s,s.VERTEX_SHADER,S),T=Hm(s,s.FRAGMENT_SHADER,M);s.attachShader(y,_),s.attachShader(y,T),t.index0AttributeName!==void 0?s.bindAttribLocation(y,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(y,0,"position"),s.linkProgram(y);function w(R){if(i.debug.checkShaderErrors){let I=s.getProgramInfoLog(y)||"",D=s.getShaderInfoLog(_)||"",B=s.getShaderInfoLog(T)||"",P=I.trim(),G=D.trim(),W=B.trim(),k=!0,Q=!0;if(s.getProgramParameter(y,s.LINK_STATUS)===!1)if(k=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,y,_,T);else{let q=Wm(s,_,"vertex"),ee=Wm(s,T,"fragment");De("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(y,s.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+P+`
`+q+`
`+ee)}else P!==""?Re("WebGLProgram: Program Info Log:",P):(G===""||W==="")&&(Q=!1);Q&&(R.diagnostics={runnable:k,programLog:P,vertexShader:{log:G,prefix:x},fragmentShader:{log:W,prefix:m}})}s.deleteShader(_),s.deleteShader(T),p=new Xr(s,y),v=rS(s,y)}let p;this.getUniforms=function(){return p===void 0&&w(this),p};let v;this.getAttributes=function(){return v===void 0&&w(this),v};let C=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return C===!1&&(C=s.getProgramParameter(y,KM)),C},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(y),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=jM++,this.cacheKey=e,this.usedTimes=1,this.program=y,this.vertexShader=_,this.fragmentShader=T,this}var yS=0,hd=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new ud(e),t.set(e,n)),n}},ud=class{constructor(e){this.id=yS++,this.code=e,this.usedTimes=0}};function xS(i){return i===xs||i===Ko||i===jo}function vS(i,e,t,n,s,r){let o=new Rr,a=new hd,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(p){return l.add(p),p===0?"uv":`uv${p}`}function y(p,v,C,R,I,D){let B=R.fog,P=I.geometry,G=p.isMeshStandardMaterial||p.isMeshLambertMaterial||p.isMeshPhongMaterial?R.environment:null,W=p.isMeshStandardMaterial||p.isMeshLambertMaterial&&!p.envMap||p.isMeshPhongMaterial&&!p.envMap,k=e.get(p.envMap||G,W),Q=d[p.type],q=n.precision;p.precision!==null&&(q=n.getMaxPrecision(p.precision),q!==p.precision&&Re("WebGLProgram.getParameters:",p.precision,"not supported, using",q,"instead."));let ee=P.morphAttributes.position||P.morphAttributes.normal||P.morphAttributes.color,te=ee!==void 0?ee.length:0,_e=0;P.morphAttributes.position!==void 0&&(_e=1),P.morphAttributes.normal!==void 0&&(_e=2),P.morphAttributes.color!==void 0&&(_e=3);let Ae,Y,re,ve;if(Q){let ge=Si[Q];Ae=ge.vertexShader,Y=ge.fragmentShader}else{Ae=p.vertexShader,Y=p.fragmentShader;let ge=a.getVertexShaderStage(p),ht=a.getFragmentShaderStage(p);a.update(p,ge,ht),re=ge.id,ve=ht.id}let Pe=i.getRenderTarget(),me=i.state.buffers.depth.getReversed(),Oe=I.isInstancedMesh===!0,St=I.isBatchedMesh===!0,Le=!!p.map,nt=!!p.matcap,st=!!k,We=st&&k.isPMREMTexture===!0,$t=!!p.aoMap,Nt=!!p.lightMap,Mn=!!p.bumpMap&&p.wireframe===!1,wt=!!p.normalMap,pi=!!p.displacementMap,Ht=!!p.emissiveMap,zn=!!p.metalnessMap,Vn=!!p.roughnessMap,Hn=p.anisotropy>0,O=p.clearcoat>0,Gn=p.diffuseRoughness>0,_t=p.dispersion>0,bt=p.retroreflectivity>0,pe=p.iridescence>0,Dt=p.sheen>0,Ne=p.transmission>0,Fe=Hn&&!!p.anisotropyMap,E=O&&!!p.clearcoatMap,b=O&&!!p.clearcoatNormalMap,V=O&&!!p.clearcoatRoughnessMap,ie=Gn&&!!p.diffuseRoughnessMap,ne=pe&&!!p.iridescenceMap,ae=pe&&!!p.iridescenceThicknessMap,de=Dt&&!!p.sheenColorMap,j=Dt&&!!p.sheenRoughnessMap,J=!!p.specularMap,ce=!!p.specularColorMap,L=!!p.specularIntensityMap,Z=Ne&&!!p.transmissionMap,K=Ne&&!!p.thicknessMap,he=!!p.gradientMap,oe=!!p.alphaMap,le=p.alphaTest>0,Ce=!!p.alphaHash,Xe=!!p.extensions,se=_i;p.toneMapped&&(Pe===null||Pe.isXRRenderTarget===!0)&&(se=i.toneMapping);let Ie=We?k.isCompressedCubeTexture?k.image[0].mipmaps:k.mipmaps:null,He={shaderID:Q,shaderType:p.type,shaderName:p.name,vertexShader:Ae,fragmentShader:Y,defines:p.defines,customVertexShaderID:re,customFragmentShaderID:ve,isRawShaderMaterial:p.isRawShaderMaterial===!0,glslVersion:p.glslVersion,precision:q,batching:St,batchingColor:St&&I._colorsTexture!==null,instancing:Oe,instancingColor:Oe&&I.instanceColor!==null,instancingMorph:Oe&&I.morphTexture!==null,outputColorSpace:Pe===null?i.outputColorSpace:Pe.isXRRenderTarget===!0?Pe.texture.colorSpace:$e.workingColorSpace,alphaToCoverage:!!p.alphaToCoverage,map:Le,matcap:nt,envMap:st,envMapMode:st&&k.mapping,envMapPMREM:We,envMapMaxLod:We?Ie.length-1:null,envMapSize:We?Ie[0].width:null,aoMap:$t,lightMap:Nt,bumpMap:Mn,normalMap:wt,displacementMap:pi,emissiveMap:Ht,normalMapObjectSpace:wt&&p.normalMapType===ym,normalMapTangentSpace:wt&&p.normalMapType===Gr,packedNormalMap:wt&&p.normalMapType===Gr&&xS(p.normalMap.format),metalnessMap:zn,roughnessMap:Vn,anisotropy:Hn,anisotropyMap:Fe,clearcoat:O,clearcoatMap:E,clearcoatNormalMap:b,clearcoatRoughnessMap:V,diffuseRoughness:Gn,diffuseRoughnessMap:ie,dispersion:_t,retroreflection:bt,iridescence:pe,iridescenceMap:ne,iridescenceThicknessMap:ae,sheen:Dt,sheenColorMap:de,sheenRoughnessMap:j,specularMap:J,specularColorMap:ce,specularIntensityMap:L,transmission:Ne,transmissionMap:Z,thicknessMap:K,gradientMap:he,opaque:p.transparent===!1&&p.blending===ys&&p.alphaToCoverage===!1,alphaMap:oe,alphaTest:le,alphaHash:Ce,combine:p.combine,mapUv:Le&&f(p.map.channel),aoMapUv:$t&&f(p.aoMap.channel),lightMapUv:Nt&&f(p.lightMap.channel),bumpMapUv:Mn&&f(p.bumpMap.channel),normalMapUv:wt&&f(p.normalMap.channel),displacementMapUv:pi&&f(p.displacementMap.channel),emissiveMapUv:Ht&&f(p.emissiveMap.channel),metalnessMapUv:zn&&f(p.metalnessMap.channel),roughnessMapUv:Vn&&f(p.roughnessMap.channel),anisotropyMapUv:Fe&&f(p.anisotropyMap.channel),clearcoatMapUv:E&&f(p.clearcoatMap.channel),clearcoatNormalMapUv:b&&f(p.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&f(p.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ie&&f(p.diffuseRoughnessMap.channel),iridescenceMapUv:ne&&f(p.iridescenceMap.channel),iridescenceThicknessMapUv:ae&&f(p.iridescenceThicknessMap.channel),sheenColorMapUv:de&&f(p.sheenColorMap.channel),sheenRoughnessMapUv:j&&f(p.sheenRoughnessMap.channel),specularMapUv:J&&f(p.specularMap.channel),specularColorMapUv:ce&&f(p.specularColorMap.channel),specularIntensityMapUv:L&&f(p.specularIntensityMap.channel),transmissionMapUv:Z&&f(p.transmissionMap.channel),thicknessMapUv:K&&f(p.thicknessMap.channel),alphaMapUv:oe&&f(p.alphaMap.channel),vertexTangents:!!P.attributes.tangent&&(wt||Hn),vertexNormals:!!P.attributes.normal,vertexColors:p.vertexColors,vertexAlphas:p.vertexColors===!0&&!!P.attributes.color&&P.attributes.color.itemSize===4,pointsUvs:I.isPoints===!0&&!!P.attributes.uv&&(Le||oe),fog:!!B,useFog:p.fog===!0,fogExp2:!!B&&B.isFogExp2,flatShading:p.wireframe===!1&&(p.flatShading===!0||P.attributes.normal===void 0&&wt===!1&&(p.isMeshLambertMaterial||p.isMeshPhongMaterial||p.isMeshStandardMaterial||p.isMeshPhysicalMaterial)),sizeAttenuation:p.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:me,skinning:I.isSkinnedMesh===!0,hasPositionAttribute:P.attributes.position!==void 0,morphTargets:P.morphAttributes.position!==void 0,morphNormals:P.morphAttributes.normal!==void 0,morphColors:P.morphAttributes.color!==void 0,morphTargetsCount:te,morphTextureStride:_e,numSunLights:v.sun.length,numDirLights:v.directional.length,numPointLights:v.point.length,numSpotLights:v.spot.length,numSpotLightMaps:v.spotLightMap.length,numRectAreaLights:v.rectArea.length,numHemiLights:v.hemi.length,numSunLightShadows:v.sunShadowMap.length,numDirLightShadows:v.directionalShadowMap.length,numPointLightShadows:v.pointShadowMap.length,numSpotLightShadows:v.spotShadowMap.length,numSpotLightShadowsWithMaps:v.numSpotLightShadowsWithMaps,numLightProbes:v.numLightProbes,numLightProbeGrids:D.filter(ge=>ge.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:p.dithering,shadowMapEnabled:i.shadowMap.enabled&&C.length>0,shadowMapType:i.shadowMap.type,toneMapping:se,decodeVideoTexture:Le&&p.map.isVideoTexture===!0&&$e.getTransfer(p.map.colorSpace)===lt,decodeVideoTextureEmissive:Ht&&p.emissiveMap.isVideoTexture===!0&&$e.getTransfer(p.emissiveMap.colorSpace)===lt,premultipliedAlpha:p.premultipliedAlpha,doubleSided:p.side===Lt,flipSided:p.side===jt,useDepthPacking:p.depthPacking>=0,depthPacking:p.depthPacking||0,index0AttributeName:p.index0AttributeName,extensionClipCullDistance:Xe&&p.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Xe&&p.extensions.multiDraw===!0||St)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:p.customProgramCacheKey()};return He.vertexUv1s=l.has(1),He.vertexUv2s=l.has(2),He.vertexUv3s=l.has(3),l.clear(),He}function x(p){let v=[];if(p.shaderID?v.push(p.shaderID):(v.push(p.customVertexShaderID),v.push(p.customFragmentShaderID)),p.defines!==void 0)for(let C in p.defines)v.push(C),v.push(p.defines[C]);return p.isRawShaderMaterial===!1&&(m(v,p),g(v,p),v.push(i.outputColorSpace)),v.push(p.customProgramCacheKey),v.join()}function m(p,v){p.push(v.precision),p.push(v.outputColorSpace),p.push(v.envMapMode),p.push(v.envMapPMREM),p.push(v.envMapMaxLod),p.push(v.envMapSize),p.push(v.mapUv),p.push(v.alphaMapUv),p.push(v.lightMapUv),p.push(v.aoMapUv),p.push(v.bumpMapUv),p.push(v.normalMapUv),p.push(v.displacementMapUv),p.push(v.emissiveMapUv),p.push(v.metalnessMapUv),p.push(v.roughnessMapUv),p.push(v.anisotropyMapUv),p.push(v.clearcoatMapUv),p.push(v.clearcoatNormalMapUv),p.push(v.clearcoatRoughnessMapUv),p.push(v.diffuseRoughnessMapUv),p.push(v.iridescenceMapUv),p.push(v.iridescenceThicknessMapUv),p.push(v.sheenColorMapUv),p.push(v.sheenRoughnessMapUv),p.push(v.specularMapUv),p.push(v.specularColorMapUv),p.push(v.specularIntensityMapUv),p.push(v.transmissionMapUv),p.push(v.thicknessMapUv),p.push(v.combine),p.push(v.fogExp2),p.push(v.sizeAttenuation),p.push(v.morphTargetsCount),p.push(v.numSunLights),p.push(v.numDirLights),p.push(v.numPointLights),p.push(v.numSpotLights),p.push(v.numSpotLightMaps),p.push(v.numHemiLights),p.push(v.numRectAreaLights),p.push(v.numSunLightShadows),p.push(v.numDirLightShadows),p.push(v.numPointLightShadows),p.push(v.numSpotLightShadows),p.push(v.numSpotLightShadowsWithMaps),p.push(v.numLightProbes),p.push(v.numLightProbeGrids),p.push(v.shadowMapType),p.push(v.toneMapping),p.push(v.numClippingPlanes),p.push(v.numClipIntersection),p.push(v.depthPacking)}function g(p,v){o.disableAll(),v.instancing&&o.enable(0),v.instancingColor&&o.enable(1),v.instancingMorph&&o.enable(2),v.matcap&&o.enable(3),v.envMap&&o.enable(4),v.normalMapObjectSpace&&o.enable(5),v.normalMapTangentSpace&&o.enable(6),v.clearcoat&&o.enable(7),v.iridescence&&o.enable(8),v.alphaTest&&o.enable(9),v.vertexColors&&o.enable(10),v.vertexAlphas&&o.enable(11),v.vertexUv1s&&o.enable(12),v.vertexUv2s&&o.enable(13),v.vertexUv3s&&o.enable(14),v.vertexTangents&&o.enable(15),v.anisotropy&&o.enable(16),v.alphaHash&&o.enable(17),v.batching&&o.enable(18),v.dispersion&&o.enable(19),v.retroreflection&&o.enable(24),v.diffuseRoughness&&o.enable(25),v.batchingColor&&o.enable(20),v.gradientMap&&o.enable(21),v.packedNormalMap&&o.enable(22),v.vertexNormals&&o.enable(23),p.push(o.mask),o.disableAll(),v.fog&&o.enable(0),v.useFog&&o.enable(1),v.flatShading&&o.enable(2),v.logarithmicDepthBuffer&&o.enable(3),v.reversedDepthBuffer&&o.enable(4),v.skinning&&o.enable(5),v.morphTargets&&o.enable(6),v.morphNormals&&o.enable(7),v.morphColors&&o.enable(8),v.premultipliedAlpha&&o.enable(9),v.shadowMapEnabled&&o.enable(10),v.doubleSided&&o.enable(11),v.flipSided&&o.enable(12),v.useDepthPacking&&o.enable(13),v.dithering&&o.enable(14),v.transmission&&o.enable(15),v.sheen&&o.enable(16),v.opaque&&o.enable(17),v.pointsUvs&&o.enable(18),v.decodeVideoTexture&&o.enable(19),v.decodeVideoTextureEmissive&&o.enable(20),v.alphaToCoverage&&o.enable(21),v.numLightProbeGrids>0&&o.enable(22),v.hasPositionAttribute&&o.enable(23),p.push(o.mask)}function S(p){let v=d[p.type],C;if(v){let R=Si[v];C=Cm.clone(R.uniforms)}else C=p.uniforms;return C}function M(p,v){let C=h.get(v);return C!==void 0?++C.usedTimes:(C=new gS(i,v,p,s),c.push(C),h.set(v,C)),C}function _(p){if(--p.usedTimes===0){let v=c.indexOf(p);c[v]=c[c.length-1],c.pop(),h.delete(p.cacheKey),p.destroy()}}function T(p){a.remove(p)}function w(){a.dispose()}return{getParameters:y,getProgramCacheKey:x,getUniforms:S,acquireProgram:M,releaseProgram:_,releaseShaderCache:T,programs:c,dispose:w}}function _S(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function bS(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function Km(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function jm(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,y,x,m,g){let S=i[e];return S===void 0?(S={id:d.id,object:d,geometry:f,material:y,materialVariant:o(d),groupOrder:x,renderOrder:d.renderOrder,z:m,group:g},i[e]=S):(S.id=d.id,S.object=d,S.geometry=f,S.material=y,S.materialVariant=o(d),S.groupOrder=x,S.renderOrder=d.renderOrder,S.z=m,S.group=g),e++,S}function l(d,f,y,x,m,g,S){S.reversedDepth===!0&&(m=-m);let M=a(d,f,y,x,m,g);y.transmission>0?n.push(M):y.transparent===!0?s.push(M):t.push(M)}function c(d,f,y,x,m,g){let S=a(d,f,y,x,m,g);y.transmission>0?n.unshift(S):y.transparent===!0?s.unshift(S):t.unshift(S)}function h(d,f){t.length>1&&t.sort(d||bS),n.length>1&&n.sort(f||Km),s.length>1&&s.sort(f||Km)}function u(){for(let d=e,f=i.length;d<f;d++){let y=i[d];if(y.id===null)break;y.id=null,y.object=null,y.geometry=null,y.material=null,y.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function MS(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new jm,i.set(n,[o])):s>=r.length?(o=new jm,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function SS(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new U,color:new be};break;case"SpotLight":t={position:new U,direction:new U,color:new be,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new U,color:new be,distance:0,decay:0};break;case"HemisphereLight":t={direction:new U,skyColor:new be,groundColor:new be};break;case"RectAreaLight":t={color:new be,position:new U,halfWidth:new U,halfHeight:new U};break}return i[e.id]=t,t}}}function wS(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ee};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ee};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ee,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var AS=0;function TS(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function ES(i){let e=new SS,t=wS(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new U);let s=new U,r=new ke,o=new ke;function a(c){let h=0,u=0,d=0;for(let D=0;D<9;D++)n.probe[D].set(0,0,0);let f=0,y=0,x=0,m=0,g=0,S=0,M=0,_=0,T=0,w=0,p=0,v=0,C=0,R=0;c.sort(TS);for(let D=0,B=c.length;D<B;D++){let P=c[D],G=P.color,W=P.intensity,k=P.distance,Q=null;if(P.shadow&&P.shadow.map&&(P.shadow.map.texture.format===xs?Q=P.shadow.map.texture:Q=P.shadow.map.depthTexture||P.shadow.map.texture),P.isAmbientLight)h+=G.r*W,u+=G.g*W,d+=G.b*W;else if(P.isLightProbe){for(let q=0;q<9;q++)n.probe[q].addScaledVector(P.sh.coefficients[q],W);R++}else if(P.isSunLight){let q=e.get(P);if(q.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let ee=P.shadow,te=t.get(P);te.shadowIntensity=ee.intensity,te.shadowBias=ee.bias,te.shadowNormalBias=ee.normalBias,te.shadowRadius=ee.radius,te.shadowMapSize.copy(ee.mapSize).multiply(ee.getFrameExtents()),n.sunShadow[y]=te,n.sunShadowMap[y]=Q;let _e=ee.getViewportCount();for(let Ae=0;Ae<_e;Ae++)n.sunShadowMatrix[x+Ae]=ee.getMatrix(Ae),n.sunShadowCascade[x+Ae]=ee._cascadeData[Ae];x+=_e,y++}n.sun[f]=q,f++}else if(P.isDirectionalLight){let q=e.get(P);if(q.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let ee=P.shadow,te=t.get(P);te.shadowIntensity=ee.intensity,te.shadowBias=ee.bias,te.shadowNormalBias=ee.normalBias,te.shadowRadius=ee.radius,te.shadowMapSize=ee.mapSize,n.directionalShadow[m]=te,n.directionalShadowMap[m]=Q,n.directionalShadowMatrix[m]=P.shadow.matrix,T++}n.directional[m]=q,m++}else if(P.isSpotLight){let q=e.get(P);q.position.setFromMatrixPosition(P.matrixWorld),q.color.copy(G).multiplyScalar(W),q.distance=k,q.coneCos=Math.cos(P.angle),q.penumbraCos=Math.cos(P.angle*(1-P.penumbra)),q.decay=P.decay,n.spot[S]=q;let ee=P.shadow;if(P.map&&(n.spotLightMap[v]=P.map,v++,ee.updateMatrices(P),P.castShadow&&C++),n.spotLightMatrix[S]=ee.matrix,P.castShadow){let te=t.get(P);te.shadowIntensity=ee.intensity,te.shadowBias=ee.bias,te.shadowNormalBias=ee.normalBias,te.shadowRadius=ee.radius,te.shadowMapSize=ee.mapSize,n.spotShadow[S]=te,n.spotShadowMap[S]=Q,p++}S++}else if(P.isRectAreaLight){let q=e.get(P);q.color.copy(G).multiplyScalar(W),q.halfWidth.set(P.width*.5,0,0),q.halfHeight.set(0,P.height*.5,0),n.rectArea[M]=q,M++}else if(P.isPointLight){let q=e.get(P);if(q.color.copy(P.color).multiplyScalar(P.intensity),q.distance=P.distance,q.decay=P.decay,P.castShadow){let ee=P.shadow,te=t.get(P);te.shadowIntensity=ee.intensity,te.shadowBias=ee.bias,te.shadowNormalBias=ee.normalBias,te.shadowRadius=ee.radius,te.shadowMapSize=ee.mapSize,te.shadowCameraNear=ee.camera.near,te.shadowCameraFar=ee.camera.far,n.pointShadow[g]=te,n.pointShadowMap[g]=Q,n.pointShadowMatrix[g]=P.shadow.matrix,w++}n.point[g]=q,g++}else if(P.isHemisphereLight){let q=e.get(P);q.skyColor.copy(P.color).multiplyScalar(W),q.groundColor.copy(P.groundColor).multiplyScalar(W),n.hemi[_]=q,_++}}M>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=ye.LTC_FLOAT_1,n.rectAreaLTC2=ye.LTC_FLOAT_2):(n.rectAreaLTC1=ye.LTC_HALF_1,n.rectAreaLTC2=ye.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let I=n.hash;(I.sunLength!==f||I.directionalLength!==m||I.pointLength!==g||I.spotLength!==S||I.rectAreaLength!==M||I.hemiLength!==_||I.numSunShadows!==y||I.numDirectionalShadows!==T||I.numPointShadows!==w||I.numSpotShadows!==p||I.numSpotMaps!==v||I.numLightProbes!==R)&&(n.sun.length=f,n.directional.length=m,n.spot.length=S,n.rectArea.length=M,n.point.length=g,n.hemi.length=_,n.sunShadow.length=y,n.sunShadowMap.length=y,n.sunShadowMatrix.length=x,n.sunShadowCascade.length=x,n.directionalShadow.length=T,n.directionalShadowMap.length=T,n.directionalShadowMatrix.length=T,n.pointShadow.length=w,n.pointShadowMap.length=w,n.pointShadowMatrix.length=w,n.spotShadow.length=p,n.spotShadowMap.length=p,n.spotLightMatrix.length=p+v-C,n.spotLightMap.length=v,n.numSpotLightShadowsWithMaps=C,n.numLightProbes=R,I.sunLength=f,I.directionalLength=m,I.pointLength=g,I.spotLength=S,I.rectAreaLength=M,I.hemiLength=_,I.numSunShadows=y,I.numDirectionalShadows=T,I.numPointShadows=w,I.numSpotShadows=p,I.numSpotMaps=v,I.numLightProbes=R,n.version=AS++)}function l(c,h){let u=0,d=0,f=0,y=0,x=0,m=0,g=h.matrixWorldInverse;for(let S=0,M=c.length;S<M;S++){let _=c[S];if(_.isSunLight){let T=n.sun[u];T.direction.setFromMatrixPosition(_.matrixWorld),T.direction.transformDirection(g),u++}else if(_.isDirectionalLight){let T=n.directional[d];T.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),T.direction.sub(s),T.direction.transformDirection(g),d++}else if(_.isSpotLight){let T=n.spot[y];T.position.setFromMatrixPosition(_.matrixWorld),T.position.applyMatrix4(g),T.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),T.direction.sub(s),T.direction.transformDirection(g),y++}else if(_.isRectAreaLight){let T=n.rectArea[x];T.position.setFromMatrixPosition(_.matrixWorld),T.position.applyMatrix4(g),o.identity(),r.copy(_.matrixWorld),r.premultiply(g),o.extractRotation(r),T.halfWidth.set(_.width*.5,0,0),T.halfHeight.set(0,_.height*.5,0),T.halfWidth.applyMatrix4(o),T.halfHeight.applyMatrix4(o),x++}else if(_.isPointLight){let T=n.point[f];T.position.setFromMatrixPosition(_.matrixWorld),T.position.applyMatrix4(g),f++}else if(_.isHemisphereLight){let T=n.hemi[m];T.direction.setFromMatrixPosition(_.matrixWorld),T.direction.transformDirection(g),m++}}}return{setup:a,setupView:l,state:n}}function Jm(i){let e=new ES(i),t=[],n=[],s=[];function r(u){h.camera=u,t.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function RS(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Jm(i),e.set(s,[a])):r>=o.length?(a=new Jm(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var CS=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,PS=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,IS=[new U(1,0,0),new U(-1,0,0),new U(0,1,0),new U(0,-1,0),new U(0,0,1),new U(0,0,-1)],LS=[new U(0,-1,0),new U(0,-1,0),new U(0,0,1),new U(0,0,-1),new U(0,-1,0),new U(0,-1,0)],Zm=new ke,Zo=new U,rd=new U;function NS(i,e,t){let n=new us,s=new Ee,r=new Ee,o=new it,a=new ul,l=new dl,c={},h=t.maxTextureSize,u={[vi]:jt,[jt]:vi,[Lt]:Lt},d=new An({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Ee},radius:{value:4}},vertexShader:CS,fragmentShader:PS}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let y=new Je;y.setAttribute("position",new ze(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new je(y,d),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Ho;let g=this.type;this.render=function(w,p,v){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||w.length===0)return;this.type===$p&&(Re("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Ho);let C=i.getRenderTarget(),R=i.getActiveCubeFace(),I=i.getActiveMipmapLevel(),D=i.state;D.setBlending(ci),D.buffers.depth.getReversed()===!0?D.buffers.color.setClear(0,0,0,0):D.buffers.color.setClear(1,1,1,1),D.buffers.depth.setTest(!0),D.setScissorTest(!1);let B=g!==this.type;B&&p.traverse(function(P){P.material&&(Array.isArray(P.material)?P.material.forEach(G=>G.needsUpdate=!0):P.material.needsUpdate=!0)});for(let P=0,G=w.length;P<G;P++){let W=w[P],k=W.shadow;if(k===void 0){Re("WebGLShadowMap:",W,"has no shadow.");continue}if(k.autoUpdate===!1&&k.needsUpdate===!1)continue;s.copy(k.mapSize);let Q=k.getFrameExtents();s.multiply(Q),r.copy(k.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/Q.x),s.x=r.x*Q.x,k.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/Q.y),s.y=r.y*Q.y,k.mapSize.y=r.y));let q=i.state.buffers.depth.getReversed();if(k.camera._reversedDepth=q,k.map===null||B===!0){if(k.map!==null&&(k.map.depthTexture!==null&&(k.map.depthTexture.dispose(),k.map.depthTexture=null),k.map.dispose()),this.type===Fr){if(W.isPointLight){Re("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}k.map=new mn(s.x,s.y,{format:xs,type:hi,minFilter:Ot,magFilter:Ot,generateMipmaps:!1}),k.map.texture.name=W.name+".shadowMap",k.map.depthTexture=new Fi(s.x,s.y,Jt),k.map.depthTexture.name=W.name+".shadowMapDepth",k.map.depthTexture.format=Ui,k.map.depthTexture.compareFunction=null,k.map.depthTexture.minFilter=Mt,k.map.depthTexture.magFilter=Mt}else W.isPointLight?(k.map=new ea(s.x),k.map.depthTexture=new Po(s.x,Cn)):(k.map=new mn(s.x,s.y),k.map.depthTexture=new Fi(s.x,s.y,Cn)),k.map.depthTexture.name=W.name+".shadowMap",k.map.depthTexture.format=Ui,this.type===Ho?(k.map.depthTexture.compareFunction=q?qu:Xu,k.map.depthTexture.minFilter=Ot,k.map.depthTexture.magFilter=Ot):(k.map.depthTexture.compareFunction=null,k.map.depthTexture.minFilter=Mt,k.map.depthTexture.magFilter=Mt);k.camera.updateProjectionMatrix()}k.map.isWebGLCubeRenderTarget!==!0&&(k.map.width!==s.x||k.map.height!==s.y)&&k.map.setSize(s.x,s.y);let ee=k.map.isWebGLCubeRenderTarget?6:k.getViewportCount();W.isPointLight!==!0&&k.updateMatrices(W,v);let te=(k.camera.layers.mask&4294967294)!==0?k.camera.layers:v.layers;for(let _e=0;_e<ee;_e++){let Ae=k.getCamera(_e);if(W.isPointLight){let Y=k.camera,re=k.matrix,ve=W.distance||Y.far;ve!==Y.far&&(Y.far=ve,Y.updateProjectionMatrix()),Zo.setFromMatrixPosition(W.matrixWorld),Y.position.copy(Zo),rd.copy(Y.position),rd.add(IS[_e]),Y.up.copy(LS[_e]),Y.lookAt(rd),Y.updateMatrixWorld(),re.makeTranslation(-Zo.x,-Zo.y,-Zo.z),Zm.multiplyMatrices(Y.projectionMatrix,Y.matrixWorldInverse),k._frustum.setFromProjectionMatrix(Zm,Y.coordinateSystem,Y.reversedDepth)}if(k.map.isWebGLCubeRenderTarget)i.setRenderTarget(k.map,_e),i.clear();else{_e===0&&(i.setRenderTarget(k.map),i.clear());let Y=k.getViewport(_e);o.set(r.x*Y.x,r.y*Y.y,r.x*Y.z,r.y*Y.w),D.viewport(o)}n=k.getFrustum(_e),_(p,v,Ae,W,te,this.type)}k.isPointLightShadow!==!0&&this.type===Fr&&S(k,v),k.needsUpdate=!1}g=this.type,m.needsUpdate=!1,i.setRenderTarget(C,R,I)};function S(w,p){let v=e.update(x);d.defines.VSM_SAMPLES!==w.blurSamples&&(d.defines.VSM_SAMPLES=w.blurSamples,f.defines.VSM_SAMPLES=w.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),w.mapPass===null?w.mapPass=new mn(s.x,s.y,{format:xs,type:hi}):(w.mapPass.width!==w.map.width||w.mapPass.height!==w.map.height)&&w.mapPass.setSize(w.map.width,w.map.height),d.uniforms.shadow_pass.value=w.map.depthTexture,d.uniforms.resolution.value.set(w.map.width,w.map.height),d.uniforms.radius.value=w.radius,i.setRenderTarget(w.mapPass),i.clear(),i.renderBufferDirect(p,null,v,d,x,null),f.uniforms.shadow_pass.value=w.mapPass.texture,f.uniforms.resolution.value.set(w.map.width,w.map.height),f.uniforms.radius.value=w.radius,i.setRenderTarget(w.map),i.clear(),i.renderBufferDirect(p,null,v,f,x,null)}function M(w,p,v,C){let R=null,I=v.isPointLight===!0?w.customDistanceMaterial:w.customDepthMaterial;if(I!==void 0)R=I;else if(R=v.isPointLight===!0?l:a,i.localClippingEnabled&&p.clipShadows===!0&&Array.isArray(p.clippingPlanes)&&p.clippingPlanes.length!==0||p.displacementMap&&p.displacementScale!==0||p.alphaMap&&p.alphaTest>0||p.map&&p.alphaTest>0||p.alphaToCoverage===!0){let D=R.uuid,B=p.uuid,P=c[D];P===void 0&&(P={},c[D]=P);let G=P[B];G===void 0&&(G=R.clone(),P[B]=G,p.addEventListener("dispose",T)),R=G}if(R.visible=p.visible,R.wireframe=p.wireframe,C===Fr?R.side=p.shadowSide!==null?p.shadowSide:p.side:R.side=p.shadowSide!==null?p.shadowSide:u[p.side],R.alphaMap=p.alphaMap,R.alphaTest=p.alphaToCoverage===!0?.5:p.alphaTest,R.map=p.map,R.clipShadows=p.clipShadows,R.clippingPlanes=p.clippingPlanes,R.clipIntersection=p.clipIntersection,R.displacementMap=p.displacementMap,R.displacementScale=p.displacementScale,R.displacementBias=p.displacementBias,R.wireframeLinewidth=p.wireframeLinewidth,R.linewidth=p.linewidth,v.isPointLight===!0&&R.isMeshDistanceMaterial===!0){let D=i.properties.get(R);D.light=v}return R}function _(w,p,v,C,R,I){if(w.visible===!1)return;if(w.layers.test(R)&&(w.isMesh||w.isLine||w.isPoints)&&(w.castShadow||w.receiveShadow&&I===Fr)&&(!w.frustumCulled||w.intersectsFrustum(n))){w.modelViewMatrix.multiplyMatrices(v.matrixWorldInverse,w.matrixWorld);let P=e.update(w),G=w.material;if(Array.isArray(G)){let W=P.groups;for(let k=0,Q=W.length;k<Q;k++){let q=W[k],ee=G[q.materialIndex];if(ee&&ee.visible){let te=M(w,ee,C,I);w.onBeforeShadow(i,w,p,v,P,te,q),i.renderBufferDirect(v,null,P,te,w,q),w.onAfterShadow(i,w,p,v,P,te,q)}}}else if(G.visible){let W=M(w,G,C,I);w.onBeforeShadow(i,w,p,v,P,W,null),i.renderBufferDirect(v,null,P,W,w,null),w.onAfterShadow(i,w,p,v,P,W,null)}}let B=w.children;for(let P=0,G=B.length;P<G;P++)_(B[P],p,v,C,R,I)}function T(w){w.target.removeEventListener("dispose",T);for(let v in c){let C=c[v],R=w.target.uuid;R in C&&(C[R].dispose(),delete C[R])}}}function DS(i,e){function t(){let L=!1,Z=new it,K=null,he=new it(0,0,0,0);return{setMask:function(oe){K!==oe&&!L&&(i.colorMask(oe,oe,oe,oe),K=oe)},setLocked:function(oe){L=oe},setClear:function(oe,le,Ce,Xe,se){se===!0&&(oe*=Xe,le*=Xe,Ce*=Xe),Z.set(oe,le,Ce,Xe),he.equals(Z)===!1&&(i.clearColor(oe,le,Ce,Xe),he.copy(Z))},reset:function(){L=!1,K=null,he.set(-1,0,0,0)}}}function n(){let L=!1,Z=!1,K=null,he=null,oe=null;return{setReversed:function(le){if(Z!==le){let Ce=e.get("EXT_clip_control");le?Ce.clipControlEXT(Ce.LOWER_LEFT_EXT,Ce.ZERO_TO_ONE_EXT):Ce.clipControlEXT(Ce.LOWER_LEFT_EXT,Ce.NEGATIVE_ONE_TO_ONE_EXT),Z=le;let Xe=oe;oe=null,this.setClear(Xe)}},getReversed:function(){return Z},setTest:function(le){le?me(i.DEPTH_TEST):Oe(i.DEPTH_TEST)},setMask:function(le){K!==le&&!L&&(i.depthMask(le),K=le)},setFunc:function(le){if(Z&&(le=Em[le]),he!==le){switch(le){case Ja:i.depthFunc(i.NEVER);break;case Za:i.depthFunc(i.ALWAYS);break;case Qa:i.depthFunc(i.LESS);break;case Mr:i.depthFunc(i.LEQUAL);break;case el:i.depthFunc(i.EQUAL);break;case tl:i.depthFunc(i.GEQUAL);break;case nl:i.depthFunc(i.GREATER);break;case il:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}he=le}},setLocked:function(le){L=le},setClear:function(le){oe!==le&&(oe=le,Z&&(le=1-le),i.clearDepth(le))},reset:function(){L=!1,K=null,he=null,oe=null,Z=!1}}}function s(){let L=!1,Z=null,K=null,he=null,oe=null,le=null,Ce=null,Xe=null,se=null;return{setTest:function(Ie){L||(Ie?me(i.STENCIL_TEST):Oe(i.STENCIL_TEST))},setMask:function(Ie){Z!==Ie&&!L&&(i.stencilMask(Ie),Z=Ie)},setFunc:function(Ie,He,ge){(K!==Ie||he!==He||oe!==ge)&&(i.stencilFunc(Ie,He,ge),K=Ie,he=He,oe=ge)},setOp:function(Ie,He,ge){(le!==Ie||Ce!==He||Xe!==ge)&&(i.stencilOp(Ie,He,ge),le=Ie,Ce=He,Xe=ge)},setLocked:function(Ie){L=Ie},setClear:function(Ie){se!==Ie&&(i.clearStencil(Ie),se=Ie)},reset:function(){L=!1,Z=null,K=null,he=null,oe=null,le=null,Ce=null,Xe=null,se=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,y=[],x=null,m=!1,g=null,S=null,M=null,_=null,T=null,w=null,p=null,v=new be(0,0,0),C=0,R=!1,I=null,D=null,B=null,P=null,G=null,W=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),k=!1,Q=0,q=i.getParameter(i.VERSION);q.indexOf("WebGL")!==-1?(Q=parseFloat(/^WebGL (\d)/.exec(q)[1]),k=Q>=1):q.indexOf("OpenGL ES")!==-1&&(Q=parseFloat(/^OpenGL ES (\d)/.exec(q)[1]),k=Q>=2);let ee=null,te={},_e=i.getParameter(i.SCISSOR_BOX),Ae=i.getParameter(i.VIEWPORT),Y=new it().fromArray(_e),re=new it().fromArray(Ae);function ve(L,Z,K,he){let oe=new Uint8Array(4),le=i.createTexture();i.bindTexture(L,le),i.texParameteri(L,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(L,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Ce=0;Ce<K;Ce++)L===i.TEXTURE_3D||L===i.TEXTURE_2D_ARRAY?i.texImage3D(Z,0,i.RGBA,1,1,he,0,i.RGBA,i.UNSIGNED_BYTE,oe):i.texImage2D(Z+Ce,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,oe);return le}let Pe={};Pe[i.TEXTURE_2D]=ve(i.TEXTURE_2D,i.TEXTURE_2D,1),Pe[i.TEXTURE_CUBE_MAP]=ve(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Pe[i.TEXTURE_2D_ARRAY]=ve(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Pe[i.TEXTURE_3D]=ve(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),me(i.DEPTH_TEST),o.setFunc(Mr),Mn(!1),wt(Au),me(i.CULL_FACE),$t(ci);function me(L){h[L]!==!0&&(i.enable(L),h[L]=!0)}function Oe(L){h[L]!==!1&&(i.disable(L),h[L]=!1)}function St(L,Z){return d[L]!==Z?(i.bindFramebuffer(L,Z),d[L]=Z,L===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=Z),L===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=Z),!0):!1}function Le(L,Z){let K=y,he=!1;if(L){K=f.get(Z),K===void 0&&(K=[],f.set(Z,K));let oe=L.textures;if(K.length!==oe.length||K[0]!==i.COLOR_ATTACHMENT0){for(let le=0,Ce=oe.length;le<Ce;le++)K[le]=i.COLOR_ATTACHMENT0+le;K.length=oe.length,he=!0}}else K[0]!==i.BACK&&(K[0]=i.BACK,he=!0);he&&i.drawBuffers(K)}function nt(L){return x!==L?(i.useProgram(L),x=L,!0):!1}let st={[Xs]:i.FUNC_ADD,[Kp]:i.FUNC_SUBTRACT,[jp]:i.FUNC_REVERSE_SUBTRACT};st[Jp]=i.MIN,st[Zp]=i.MAX;let We={[Qp]:i.ZERO,[em]:i.ONE,[tm]:i.SRC_COLOR,[Cu]:i.SRC_ALPHA,[am]:i.SRC_ALPHA_SATURATE,[rm]:i.DST_COLOR,[im]:i.DST_ALPHA,[nm]:i.ONE_MINUS_SRC_COLOR,[Pu]:i.ONE_MINUS_SRC_ALPHA,[om]:i.ONE_MINUS_DST_COLOR,[sm]:i.ONE_MINUS_DST_ALPHA,[lm]:i.CONSTANT_COLOR,[cm]:i.ONE_MINUS_CONSTANT_COLOR,[hm]:i.CONSTANT_ALPHA,[um]:i.ONE_MINUS_CONSTANT_ALPHA};function $t(L,Z,K,he,oe,le,Ce,Xe,se,Ie){if(L===ci){m===!0&&(Oe(i.BLEND),m=!1);return}if(m===!1&&(me(i.BLEND),m=!0),L!==Yp){if(L!==g||Ie!==R){if((S!==Xs||T!==Xs)&&(i.blendEquation(i.FUNC_ADD),S=Xs,T=Xs),Ie)switch(L){case ys:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Tu:i.blendFunc(i.ONE,i.ONE);break;case Eu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Ru:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:De("WebGLState: Invalid blending: ",L);break}else switch(L){case ys:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Tu:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Eu:De("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Ru:De("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:De("WebGLState: Invalid blending: ",L);break}M=null,_=null,w=null,p=null,v.set(0,0,0),C=0,g=L,R=Ie}return}oe=oe||Z,le=le||K,Ce=Ce||he,(Z!==S||oe!==T)&&(i.blendEquationSeparate(st[Z],st[oe]),S=Z,T=oe),(K!==M||he!==_||le!==w||Ce!==p)&&(i.blendFuncSeparate(We[K],We[he],We[le],We[Ce]),M=K,_=he,w=le,p=Ce),(Xe.equals(v)===!1||se!==C)&&(i.blendColor(Xe.r,Xe.g,Xe.b,se),v.copy(Xe),C=se),g=L,R=!1}function Nt(L,Z){L.side===Lt?Oe(i.CULL_FACE):me(i.CULL_FACE);let K=L.side===jt;Z&&(K=!K),Mn(K),L.blending===ys&&L.transparent===!1?$t(ci):$t(L.blending,L.blendEquation,L.blendSrc,L.blendDst,L.blendEquationAlpha,L.blendSrcAlpha,L.blendDstAlpha,L.blendColor,L.blendAlpha,L.premultipliedAlpha),o.setFunc(L.depthFunc),o.setTest(L.depthTest),o.setMask(L.depthWrite),r.setMask(L.colorWrite);let he=L.stencilWrite;a.setTest(he),he&&(a.setMask(L.stencilWriteMask),a.setFunc(L.stencilFunc,L.stencilRef,L.stencilFuncMask),a.setOp(L.stencilFail,L.stencilZFail,L.stencilZPass)),Ht(L.polygonOffset,L.polygonOffsetFactor,L.polygonOffsetUnits),L.alphaToCoverage===!0?me(i.SAMPLE_ALPHA_TO_COVERAGE):Oe(i.SAMPLE_ALPHA_TO_COVERAGE)}function Mn(L){I!==L&&(L?i.frontFace(i.CW):i.frontFace(i.CCW),I=L)}function wt(L){L!==Xp?(me(i.CULL_FACE),L!==D&&(L===Au?i.cullFace(i.BACK):L===qp?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Oe(i.CULL_FACE),D=L}function pi(L){L!==B&&(k&&i.lineWidth(L),B=L)}function Ht(L,Z,K){L?(me(i.POLYGON_OFFSET_FILL),(P!==Z||G!==K)&&(P=Z,G=K,o.getReversed()&&(Z=-Z,K=-K),i.polygonOffset(Z,K))):Oe(i.POLYGON_OFFSET_FILL)}function zn(L){L?me(i.SCISSOR_TEST):Oe(i.SCISSOR_TEST)}function Vn(L){L===void 0&&(L=i.TEXTURE0+W-1),ee!==L&&(i.activeTexture(L),ee=L)}function Hn(L,Z,K){K===void 0&&(ee===null?K=i.TEXTURE0+W-1:K=ee);let he=te[K];he===void 0&&(he={type:void 0,texture:void 0},te[K]=he),(he.type!==L||he.texture!==Z)&&(ee!==K&&(i.activeTexture(K),ee=K),i.bindTexture(L,Z||Pe[L]),he.type=L,he.texture=Z)}function O(){let L=te[ee];L!==void 0&&L.type!==void 0&&(i.bindTexture(L.type,null),L.type=void 0,L.texture=void 0)}function Gn(){try{i.compressedTexImage2D(...arguments)}catch(L){De("WebGLState:",L)}}function _t(){try{i.compressedTexImage3D(...arguments)}catch(L){De("WebGLState:",L)}}function bt(){try{i.texSubImage2D(...arguments)}catch(L){De("WebGLState:",L)}}function pe(){try{i.texSubImage3D(...arguments)}catch(L){De("WebGLState:",L)}}function Dt(){try{i.compressedTexSubImage2D(...arguments)}catch(L){De("WebGLState:",L)}}function Ne(){try{i.compressedTexSubImage3D(...arguments)}catch(L){De("WebGLState:",L)}}function Fe(){try{i.texStorage2D(...arguments)}catch(L){De("WebGLState:",L)}}function E(){try{i.texStorage3D(...arguments)}catch(L){De("WebGLState:",L)}}function b(){try{i.texImage2D(...arguments)}catch(L){De("WebGLState:",L)}}function V(){try{i.texImage3D(...arguments)}catch(L){De("WebGLState:",L)}}function ie(L){return u[L]!==void 0?u[L]:i.getParameter(L)}function ne(L,Z){u[L]!==Z&&(i.pixelStorei(L,Z),u[L]=Z)}function ae(L){Y.equals(L)===!1&&(i.scissor(L.x,L.y,L.z,L.w),Y.copy(L))}function de(L){re.equals(L)===!1&&(i.viewport(L.x,L.y,L.z,L.w),re.copy(L))}function j(L,Z){let K=c.get(Z);K===void 0&&(K=new WeakMap,c.set(Z,K));let he=K.get(L);he===void 0&&(he=i.getUniformBlockIndex(Z,L.name),i.uniformBlockBinding(Z,he,he),K.set(L,he))}function J(L,Z,K){let oe=c.get(Z).get(L);l[oe]!==K&&(i.bindBufferBase(i.UNIFORM_BUFFER,oe,K),l[oe]=K)}function ce(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},ee=null,te={},d={},l={},f=new WeakMap,y=[],x=null,m=!1,g=null,S=null,M=null,_=null,T=null,w=null,p=null,v=new be(0,0,0),C=0,R=!1,I=null,D=null,B=null,P=null,G=null,Y.set(0,0,i.canvas.width,i.canvas.height),re.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:me,disable:Oe,bindFramebuffer:St,drawBuffers:Le,useProgram:nt,setBlending:$t,setMaterial:Nt,setFlipSided:Mn,setCullFace:wt,setLineWidth:pi,setPolygonOffset:Ht,setScissorTest:zn,activeTexture:Vn,bindTexture:Hn,unbindTexture:O,compressedTexImage2D:Gn,compressedTexImage3D:_t,texImage2D:b,texImage3D:V,pixelStorei:ne,getParameter:ie,updateUBOMapping:j,uniformBlockBinding:J,texStorage2D:Fe,texStorage3D:E,texSubImage2D:bt,texSubImage3D:pe,compressedTexSubImage2D:Dt,compressedTexSubImage3D:Ne,scissor:ae,viewport:de,reset:ce}}function US(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Ee,h=new WeakMap,u=new Set,d,f=new WeakMap,y=new Set,x=new FinalizationRegistry(E=>y.delete(E)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(E,b){return m?new OffscreenCanvas(E,b):Ar("canvas")}function S(E,b,V){let ie=1,ne=Fe(E);if((ne.width>V||ne.height>V)&&(ie=V/Math.max(ne.width,ne.height)),ie<1)if(typeof HTMLImageElement<"u"&&E instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&E instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&E instanceof ImageBitmap||typeof VideoFrame<"u"&&E instanceof VideoFrame){let ae=Math.floor(ie*ne.width),de=Math.floor(ie*ne.height);d===void 0&&(d=g(ae,de));let j=b?g(ae,de):d;return j.width=ae,j.height=de,j.getContext("2d").drawImage(E,0,0,ae,de),Re("WebGLRenderer: Texture has been resized from ("+ne.width+"x"+ne.height+") to ("+ae+"x"+de+")."),j}else return"data"in E&&Re("WebGLRenderer: Image in DataTexture is too big ("+ne.width+"x"+ne.height+")."),E;return E}function M(E){return E.generateMipmaps}function _(E){i.generateMipmap(E)}function T(E){return E.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:E.isWebGL3DRenderTarget?i.TEXTURE_3D:E.isWebGLArrayRenderTarget||E.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function w(E,b,V,ie,ne,ae=!1){if(E!==null){if(i[E]!==void 0)return i[E];Re("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+E+"'")}let de;ie&&(de=e.get("EXT_texture_norm16"),de||Re("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let j=b;if(b===i.RED&&(V===i.FLOAT&&(j=i.R32F),V===i.HALF_FLOAT&&(j=i.R16F),V===i.UNSIGNED_BYTE&&(j=i.R8),V===i.UNSIGNED_SHORT&&de&&(j=de.R16_EXT),V===i.SHORT&&de&&(j=de.R16_SNORM_EXT)),b===i.RED_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.R8UI),V===i.UNSIGNED_SHORT&&(j=i.R16UI),V===i.UNSIGNED_INT&&(j=i.R32UI),V===i.BYTE&&(j=i.R8I),V===i.SHORT&&(j=i.R16I),V===i.INT&&(j=i.R32I)),b===i.RG&&(V===i.FLOAT&&(j=i.RG32F),V===i.HALF_FLOAT&&(j=i.RG16F),V===i.UNSIGNED_BYTE&&(j=i.RG8),V===i.UNSIGNED_SHORT&&de&&(j=de.RG16_EXT),V===i.SHORT&&de&&(j=de.RG16_SNORM_EXT)),b===i.RG_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.RG8UI),V===i.UNSIGNED_SHORT&&(j=i.RG16UI),V===i.UNSIGNED_INT&&(j=i.RG32UI),V===i.BYTE&&(j=i.RG8I),V===i.SHORT&&(j=i.RG16I),V===i.INT&&(j=i.RG32I)),b===i.RGB_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.RGB8UI),V===i.UNSIGNED_SHORT&&(j=i.RGB16UI),V===i.UNSIGNED_INT&&(j=i.RGB32UI),V===i.BYTE&&(j=i.RGB8I),V===i.SHORT&&(j=i.RGB16I),V===i.INT&&(j=i.RGB32I)),b===i.RGBA_INTEGER&&(V===i.UNSIGNED_BYTE&&(j=i.RGBA8UI),V===i.UNSIGNED_SHORT&&(j=i.RGBA16UI),V===i.UNSIGNED_INT&&(j=i.RGBA32UI),V===i.BYTE&&(j=i.RGBA8I),V===i.SHORT&&(j=i.RGBA16I),V===i.INT&&(j=i.RGBA32I)),b===i.RGB&&(V===i.UNSIGNED_SHORT&&de&&(j=de.RGB16_EXT),V===i.SHORT&&de&&(j=de.RGB16_SNORM_EXT),V===i.UNSIGNED_INT_5_9_9_9_REV&&(j=i.RGB9_E5),V===i.UNSIGNED_INT_10F_11F_11F_REV&&(j=i.R11F_G11F_B10F)),b===i.RGBA){let J=ae?vo:$e.getTransfer(ne);V===i.FLOAT&&(j=i.RGBA32F),V===i.HALF_FLOAT&&(j=i.RGBA16F),V===i.UNSIGNED_BYTE&&(j=J===lt?i.SRGB8_ALPHA8:i.RGBA8),V===i.UNSIGNED_SHORT&&de&&(j=de.RGBA16_EXT),V===i.SHORT&&de&&(j=de.RGBA16_SNORM_EXT),V===i.UNSIGNED_SHORT_4_4_4_4&&(j=i.RGBA4),V===i.UNSIGNED_SHORT_5_5_5_1&&(j=i.RGB5_A1)}return(j===i.R16F||j===i.R32F||j===i.RG16F||j===i.RG32F||j===i.RGBA16F||j===i.RGBA32F)&&e.get("EXT_color_buffer_float"),j}function p(E,b){let V;return E?b===null||b===Cn||b===Ys?V=i.DEPTH24_STENCIL8:b===Jt?V=i.DEPTH32F_STENCIL8:b===zr&&(V=i.DEPTH24_STENCIL8,Re("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):b===null||b===Cn||b===Ys?V=i.DEPTH_COMPONENT24:b===Jt?V=i.DEPTH_COMPONENT32F:b===zr&&(V=i.DEPTH_COMPONENT16),V}function v(E,b){return M(E)===!0||E.isFramebufferTexture&&E.minFilter!==Mt&&E.minFilter!==Ot?Math.log2(Math.max(b.width,b.height))+1:E.mipmaps.length>0?E.mipmaps.length:E.isCompressedTexture&&Array.isArray(E.image)?b.mipmaps.length:1}function C(E){let b=new WeakRef(E);n.get(E).__ref=b,y.add(b),x.register(E,b,b)}function R(E){let b=n.get(E).__ref;b!==void 0&&(y.delete(b),x.unregister(b))}function I(E){B(E.target)}function D(E){P(E.target)}function B(E){E.removeEventListener("dispose",I),R(E),W(E),E.isVideoTexture&&h.delete(E),E.isHTMLTexture&&u.delete(E)}function P(E){E.removeEventListener("dispose",D),R(E),Q(E)}function G(){for(let E of y){let b=E.deref();b!==void 0&&(b.isRenderTarget===!0?P(b):B(b))}y.clear(),u.clear()}function W(E){let b=n.get(E);if(b.__webglInit===void 0)return;let V=E.source,ie=f.get(V);if(ie){let ne=ie[b.__cacheKey];ne.usedTimes--,ne.usedTimes===0&&k(E),Object.keys(ie).length===0&&f.delete(V)}n.remove(E)}function k(E){let b=n.get(E);i.deleteTexture(b.__webglTexture);let V=E.source,ie=f.get(V);delete ie[b.__cacheKey],o.memory.textures--}function Q(E){let b=n.get(E);b.__depthDisposeCallback&&b.__depthDisposeCallback();let V=E.depthTexture;if(V&&V.renderTarget===E&&B(V),E.isWebGLCubeRenderTarget)for(let ne=0;ne<6;ne++){if(Array.isArray(b.__webglFramebuffer[ne]))for(let ae=0;ae<b.__webglFramebuffer[ne].length;ae++)i.deleteFramebuffer(b.__webglFramebuffer[ne][ae]);else i.deleteFramebuffer(b.__webglFramebuffer[ne]);b.__webglDepthbuffer&&i.deleteRenderbuffer(b.__webglDepthbuffer[ne])}else{if(Array.isArray(b.__webglFramebuffer))for(let ne=0;ne<b.__webglFramebuffer.length;ne++)i.deleteFramebuffer(b.__webglFramebuffer[ne]);else i.deleteFramebuffer(b.__webglFramebuffer);if(b.__webglDepthbuffer&&i.deleteRenderbuffer(b.__webglDepthbuffer),b.__webglMultisampledFramebuffer&&i.deleteFramebuffer(b.__webglMultisampledFramebuffer),b.__webglColorRenderbuffer)for(let ne=0;ne<b.__webglColorRenderbuffer.length;ne++)b.__webglColorRenderbuffer[ne]&&i.deleteRenderbuffer(b.__webglColorRenderbuffer[ne]);b.__webglDepthRenderbuffer&&i.deleteRenderbuffer(b.__webglDepthRenderbuffer)}let ie=E.textures;for(let ne=0,ae=ie.length;ne<ae;ne++){let de=n.get(ie[ne]);de.__webglTexture&&(i.deleteTexture(de.__webglTexture),o.memory.textures--),n.remove(ie[ne])}n.remove(E)}let q=0;function ee(){q=0}function te(){return q}function _e(E){q=E}function Ae(){let E=q;return E>=s.maxTextures&&Re("WebGLTextures: Trying to use "+(E+1)+" texture units while this GPU supports only "+s.maxTextures),q+=1,E}function Y(E){let b=[];return b.push(E.wrapS),b.push(E.wrapT),b.push(E.wrapR||0),b.push(E.magFilter),b.push(E.minFilter),b.push(E.anisotropy),b.push(E.internalFormat),b.push(E.format),b.push(E.type),b.push(E.generateMipmaps),b.push(E.mipmapsAutoUpdate),b.push(E.premultiplyAlpha),b.push(E.flipY),b.push(E.unpackAlignment),b.push(E.colorSpace),b.join()}function re(E,b){let V=n.get(E);if(E.isVideoTexture&&Dt(E),E.isRenderTargetTexture===!1&&E.isExternalTexture!==!0&&E.version>0&&V.__version!==E.version){let ie=E.image;if(ie===null)Re("WebGLRenderer: Texture marked for update but no image data found.");else if(ie.complete===!1)Re("WebGLRenderer: Texture marked for update but image is incomplete");else{Nt(V,E,b);return}}else E.isExternalTexture&&(V.__webglTexture=E.sourceTexture?E.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,V.__webglTexture,i.TEXTURE0+b)}function ve(E,b){let V=n.get(E);if(E.isRenderTargetTexture===!1&&E.version>0&&V.__version!==E.version){Nt(V,E,b);return}else E.isExternalTexture&&(V.__webglTexture=E.sourceTexture?E.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,V.__webglTexture,i.TEXTURE0+b)}function Pe(E,b){let V=n.get(E);if(E.isRenderTargetTexture===!1&&E.version>0&&V.__version!==E.version){Nt(V,E,b);return}t.bindTexture(i.TEXTURE_3D,V.__webglTexture,i.TEXTURE0+b)}function me(E,b){let V=n.get(E);if(E.version>0&&V.__version!==E.version){Mn(V,E,b);return}t.bindTexture(i.TEXTURE_CUBE_MAP,V.__webglTexture,i.TEXTURE0+b)}let Oe={[$n]:i.REPEAT,[Xn]:i.CLAMP_TO_EDGE,[Sr]:i.MIRRORED_REPEAT},St={[Mt]:i.NEAREST,[Ml]:i.NEAREST_MIPMAP_NEAREST,[$s]:i.NEAREST_MIPMAP_LINEAR,[Ot]:i.LINEAR,[kr]:i.LINEAR_MIPMAP_NEAREST,[Kn]:i.LINEAR_MIPMAP_LINEAR},Le={[vm]:i.NEVER,[$u]:i.ALWAYS,[_m]:i.LESS,[Xu]:i.LEQUAL,[bm]:i.EQUAL,[qu]:i.GEQUAL,[Mm]:i.GREATER,[Sm]:i.NOTEQUAL};function nt(E,b){if(b.type===Jt&&e.has("OES_texture_float_linear")===!1&&(b.magFilter===Ot||b.magFilter===kr||b.magFilter===$s||b.magFilter===Kn||b.minFilter===Ot||b.minFilter===kr||b.minFilter===$s||b.minFilter===Kn)&&Re("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(E,i.TEXTURE_WRAP_S,Oe[b.wrapS]),i.texParameteri(E,i.TEXTURE_WRAP_T,Oe[b.wrapT]),(E===i.TEXTURE_3D||E===i.TEXTURE_2D_ARRAY)&&i.texParameteri(E,i.TEXTURE_WRAP_R,Oe[b.wrapR]),i.texParameteri(E,i.TEXTURE_MAG_FILTER,St[b.magFilter]),i.texParameteri(E,i.TEXTURE_MIN_FILTER,St[b.minFilter]),b.compareFunction&&(i.texParameteri(E,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(E,i.TEXTURE_COMPARE_FUNC,Le[b.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(b.magFilter===Mt||b.minFilter!==$s&&b.minFilter!==Kn||b.type===Jt&&e.has("OES_texture_float_linear")===!1)return;if(b.anisotropy>1||n.get(b).__currentAnisotropy){let V=e.get("EXT_texture_filter_anisotropic");i.texParameterf(E,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(b.anisotropy,s.getMaxAnisotropy())),n.get(b).__currentAnisotropy=b.anisotropy}}}function st(E,b){let V=!1;E.__webglInit===void 0&&(E.__webglInit=!0,b.addEventListener("dispose",I),C(b));let ie=b.source,ne=f.get(ie);ne===void 0&&(ne={},f.set(ie,ne));let ae=Y(b);if(ae!==E.__cacheKey){ne[ae]===void 0&&(ne[ae]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,V=!0),ne[ae].usedTimes++;let de=ne[E.__cacheKey];de!==void 0&&(ne[E.__cacheKey].usedTimes--,de.usedTimes===0&&k(b)),E.__cacheKey=ae,E.__webglTexture=ne[ae].texture}return V}function We(E,b,V){return Math.floor(Math.floor(E/V)/b)}function $t(E,b,V,ie){let ae=E.updateRanges;if(ae.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,b.width,b.height,V,ie,b.data);else{ae.sort((L,Z)=>L.start-Z.start);let de=0;for(let L=1;L<ae.length;L++){let Z=ae[de],K=ae[L],he=Z.start+Z.count,oe=We(K.start,b.width,4),le=We(Z.start,b.width,4);K.start<=he+1&&oe===le&&We(K.start+K.count-1,b.width,4)===oe?Z.count=Math.max(Z.count,K.start+K.count-Z.start):(++de,ae[de]=K)}ae.length=de+1;let j=t.getParameter(i.UNPACK_ROW_LENGTH),J=t.getParameter(i.UNPACK_SKIP_PIXELS),ce=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,b.width);for(let L=0,Z=ae.length;L<Z;L++){let K=ae[L],he=Math.floor(K.start/4),oe=Math.ceil(K.count/4),le=he%b.width,Ce=Math.floor(he/b.width),Xe=oe,se=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,le),t.pixelStorei(i.UNPACK_SKIP_ROWS,Ce),t.texSubImage2D(i.TEXTURE_2D,0,le,Ce,Xe,se,V,ie,b.data)}E.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,j),t.pixelStorei(i.UNPACK_SKIP_PIXELS,J),t.pixelStorei(i.UNPACK_SKIP_ROWS,ce)}}function Nt(E,b,V){let ie=i.TEXTURE_2D;(b.isDataArrayTexture||b.isCompressedArrayTexture)&&(ie=i.TEXTURE_2D_ARRAY),b.isData3DTexture&&(ie=i.TEXTURE_3D);let ne=st(E,b),ae=b.source;t.bindTexture(ie,E.__webglTexture,i.TEXTURE0+V);let de=n.get(ae);if(ae.version!==de.__version||ne===!0){if(t.activeTexture(i.TEXTURE0+V),(typeof ImageBitmap<"u"&&b.image instanceof ImageBitmap)===!1){let se=$e.getPrimaries($e.workingColorSpace),Ie=b.colorSpace===$i?null:$e.getPrimaries(b.colorSpace),He=b.colorSpace===$i||se===Ie?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,b.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,He)}t.pixelStorei(i.UNPACK_ALIGNMENT,b.unpackAlignment);let J=S(b.image,!1,s.maxTextureSize);J=Ne(b,J);let ce=r.convert(b.format,b.colorSpace),L=r.convert(b.type),Z=w(b.internalFormat,ce,L,b.normalized,b.colorSpace,b.isVideoTexture);nt(ie,b);let K,he=b.mipmaps,oe=b.isVideoTexture!==!0,le=de.__version===void 0||ne===!0,Ce=ae.dataReady,Xe=v(b,J);if(b.isDepthTexture)Z=p(b.format===qi,b.type),le&&(oe?t.texStorage2D(i.TEXTURE_2D,1,Z,J.width,J.height):t.texImage2D(i.TEXTURE_2D,0,Z,J.width,J.height,0,ce,L,null));else if(b.isDataTexture)if(he.length>0){oe&&le&&t.texStorage2D(i.TEXTURE_2D,Xe,Z,he[0].width,he[0].height);for(let se=0,Ie=he.length;se<Ie;se++)K=he[se],oe?Ce&&t.texSubImage2D(i.TEXTURE_2D,se,0,0,K.width,K.height,ce,L,K.data):t.texImage2D(i.TEXTURE_2D,se,Z,K.width,K.height,0,ce,L,K.data);b.generateMipmaps=!1}else oe?(le&&t.texStorage2D(i.TEXTURE_2D,Xe,Z,J.width,J.height),Ce&&$t(b,J,ce,L)):t.texImage2D(i.TEXTURE_2D,0,Z,J.width,J.height,0,ce,L,J.data);else if(b.isCompressedTexture)if(b.isCompressedArrayTexture){oe&&le&&t.texStorage3D(i.TEXTURE_2D_ARRAY,Xe,Z,he[0].width,he[0].height,J.depth);for(let se=0,Ie=he.length;se<Ie;se++)if(K=he[se],b.format!==an)if(ce!==null)if(oe){if(Ce)if(b.layerUpdates.size>0){let He=id(K.width,K.height,b.format,b.type);for(let ge of b.layerUpdates){let ht=K.data.subarray(ge*He/K.data.BYTES_PER_ELEMENT,(ge+1)*He/K.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,se,0,0,ge,K.width,K.height,1,ce,ht)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,se,0,0,0,K.width,K.height,J.depth,ce,K.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,se,Z,K.width,K.height,J.depth,0,K.data,0,0);else Re("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else oe?Ce&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,se,0,0,0,K.width,K.height,J.depth,ce,L,K.data):t.texImage3D(i.TEXTURE_2D_ARRAY,se,Z,K.width,K.height,J.depth,0,ce,L,K.data);b.layerUpdates.size>0&&b.clearLayerUpdates()}else{oe&&le&&t.texStorage2D(i.TEXTURE_2D,Xe,Z,he[0].width,he[0].height);for(let se=0,Ie=he.length;se<Ie;se++)K=he[se],b.format!==an?ce!==null?oe?Ce&&t.compressedTexSubImage2D(i.TEXTURE_2D,se,0,0,K.width,K.height,ce,K.data):t.compressedTexImage2D(i.TEXTURE_2D,se,Z,K.width,K.height,0,K.data):Re("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):oe?Ce&&t.texSubImage2D(i.TEXTURE_2D,se,0,0,K.width,K.height,ce,L,K.data):t.texImage2D(i.TEXTURE_2D,se,Z,K.width,K.height,0,ce,L,K.data)}else if(b.isDataArrayTexture)if(oe){if(le&&t.texStorage3D(i.TEXTURE_2D_ARRAY,Xe,Z,J.width,J.height,J.depth),Ce)if(b.layerUpdates.size>0){let se=id(J.width,J.height,b.format,b.type);for(let Ie of b.layerUpdates){let He=J.data.subarray(Ie*se/J.data.BYTES_PER_ELEMENT,(Ie+1)*se/J.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Ie,J.width,J.height,1,ce,L,He)}b.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,J.width,J.height,J.depth,ce,L,J.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,Z,J.width,J.height,J.depth,0,ce,L,J.data);else if(b.isData3DTexture)oe?(le&&t.texStorage3D(i.TEXTURE_3D,Xe,Z,J.width,J.height,J.depth),Ce&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,J.width,J.height,J.depth,ce,L,J.data)):t.texImage3D(i.TEXTURE_3D,0,Z,J.width,J.height,J.depth,0,ce,L,J.data);else if(b.isFramebufferTexture){if(le)if(oe)t.texStorage2D(i.TEXTURE_2D,Xe,Z,J.width,J.height);else{let se=J.width,Ie=J.height;for(let He=0;He<Xe;He++)t.texImage2D(i.TEXTURE_2D,He,Z,se,Ie,0,ce,L,null),se>>=1,Ie>>=1}}else if(b.isHTMLTexture){if("texElementImage2D"in i){let se=i.canvas;if(se.hasAttribute("layoutsubtree")||se.setAttribute("layoutsubtree","true"),J.parentNode!==se){se.appendChild(J),u.add(b),se.onpaint=Ie=>{let He=Ie.changedElements;for(let ge of u)He.includes(ge.image)&&(ge.needsUpdate=!0)},se.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,J);else{let He=i.RGBA,ge=i.RGBA,ht=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,He,ge,ht,J)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(he.length>0){if(oe&&le){let se=Fe(he[0]);t.texStorage2D(i.TEXTURE_2D,Xe,Z,se.width,se.height)}for(let se=0,Ie=he.length;se<Ie;se++)K=he[se],oe?Ce&&t.texSubImage2D(i.TEXTURE_2D,se,0,0,ce,L,K):t.texImage2D(i.TEXTURE_2D,se,Z,ce,L,K);b.generateMipmaps=!1}else if(oe){if(le){let se=Fe(J);t.texStorage2D(i.TEXTURE_2D,Xe,Z,se.width,se.height)}Ce&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,ce,L,J)}else t.texImage2D(i.TEXTURE_2D,0,Z,ce,L,J);M(b)&&b.mipmapsAutoUpdate===!0&&_(ie),de.__version=ae.version,b.onUpdate&&b.onUpdate(b)}E.__version=b.version}function Mn(E,b,V){if(b.image.length!==6)return;let ie=st(E,b),ne=b.source;t.bindTexture(i.TEXTURE_CUBE_MAP,E.__webglTexture,i.TEXTURE0+V);let ae=n.get(ne);if(ne.version!==ae.__version||ie===!0){t.activeTexture(i.TEXTURE0+V);let de=$e.getPrimaries($e.workingColorSpace),j=b.colorSpace===$i?null:$e.getPrimaries(b.colorSpace),J=b.colorSpace===$i||de===j?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,b.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,b.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,J);let ce=b.isCompressedTexture||b.image[0].isCompressedTexture,L=b.image[0]&&b.image[0].isDataTexture,Z=[];for(let ge=0;ge<6;ge++)!ce&&!L?Z[ge]=S(b.image[ge],!0,s.maxCubemapSize):Z[ge]=L?b.image[ge].image:b.image[ge],Z[ge]=Ne(b,Z[ge]);let K=Z[0],he=r.convert(b.format,b.colorSpace),oe=r.convert(b.type),le=w(b.internalFormat,he,oe,b.normalized,b.colorSpace),Ce=b.isVideoTexture!==!0,Xe=ae.__version===void 0||ie===!0,se=ne.dataReady,Ie=v(b,K);nt(i.TEXTURE_CUBE_MAP,b);let He;if(b.isDepthTexture){if(le=p(b.format===qi,b.type),Xe)if(Ce)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,le,K.width,K.height);else for(let ge=0;ge<6;ge++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,0,le,K.width,K.height,0,he,oe,null)}else if(ce){Ce&&Xe&&t.texStorage2D(i.TEXTURE_CUBE_MAP,Ie,le,K.width,K.height);for(let ge=0;ge<6;ge++){He=Z[ge].mipmaps;for(let ht=0;ht<He.length;ht++){let Gt=He[ht];b.format!==an?he!==null?Ce?se&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht,0,0,Gt.width,Gt.height,he,Gt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht,le,Gt.width,Gt.height,0,Gt.data):Re("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Ce?se&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht,0,0,Gt.width,Gt.height,he,oe,Gt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht,le,Gt.width,Gt.height,0,he,oe,Gt.data)}}}else{if(He=b.mipmaps,Ce&&Xe){He.length>0&&Ie++;let ge=Fe(Z[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,Ie,le,ge.width,ge.height)}for(let ge=0;ge<6;ge++)if(L){Ce?se&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,0,0,0,Z[ge].width,Z[ge].height,he,oe,Z[ge].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,0,le,Z[ge].width,Z[ge].height,0,he,oe,Z[ge].data);for(let ht=0;ht<He.length;ht++){let ns=He[ht].image[ge].image;Ce?se&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht+1,0,0,ns.width,ns.height,he,oe,ns.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht+1,le,ns.width,ns.height,0,he,oe,ns.data)}}else{Ce?se&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,0,0,0,he,oe,Z[ge]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,0,le,he,oe,Z[ge]);for(let ht=0;ht<He.length;ht++){let Gt=He[ht];Ce?se&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht+1,0,0,he,oe,Gt.image[ge]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ge,ht+1,le,he,oe,Gt.image[ge])}}}M(b)&&b.mipmapsAutoUpdate===!0&&_(i.TEXTURE_CUBE_MAP),ae.__version=ne.version,b.onUpdate&&b.onUpdate(b)}E.__version=b.version}function wt(E,b,V,ie,ne,ae){let de=r.convert(V.format,V.colorSpace),j=r.convert(V.type),J=w(V.internalFormat,de,j,V.normalized,V.colorSpace),ce=n.get(b),L=n.get(V);if(L.__renderTarget=b,!ce.__hasExternalTextures){let Z=Math.max(1,b.width>>ae),K=Math.max(1,b.height>>ae);ne===i.TEXTURE_3D||ne===i.TEXTURE_2D_ARRAY?t.texImage3D(ne,ae,J,Z,K,b.depth,0,de,j,null):t.texImage2D(ne,ae,J,Z,K,0,de,j,null)}t.bindFramebuffer(i.FRAMEBUFFER,E),pe(b)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ie,ne,L.__webglTexture,0,bt(b)):(ne===i.TEXTURE_2D||ne>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&ne<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,ie,ne,L.__webglTexture,ae),t.bindFramebuffer(i.FRAMEBUFFER,null)}function pi(E,b,V){if(i.bindRenderbuffer(i.RENDERBUFFER,E),b.depthBuffer){let ie=b.depthTexture,ne=ie&&ie.isDepthTexture?ie.type:null,ae=p(b.stencilBuffer,ne),de=b.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;pe(b)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,bt(b),ae,b.width,b.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,bt(b),ae,b.width,b.height):i.renderbufferStorage(i.RENDERBUFFER,ae,b.width,b.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,de,i.RENDERBUFFER,E)}else{let ie=b.textures;for(let ne=0;ne<ie.length;ne++){let ae=ie[ne],de=r.convert(ae.format,ae.colorSpace),j=r.convert(ae.type),J=w(ae.internalFormat,de,j,ae.normalized,ae.colorSpace);pe(b)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,bt(b),J,b.width,b.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,bt(b),J,b.width,b.height):i.renderbufferStorage(i.RENDERBUFFER,J,b.width,b.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Ht(E,b,V){let ie=b.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,E),!(b.depthTexture&&b.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ne=n.get(b.depthTexture);ne.__renderTarget=b;let ae=ie?b.depthTexture.image[0]:b.depthTexture.image;(!ne.__webglTexture||ae.width!==b.width||ae.height!==b.height)&&(ae.width=b.width,ae.height=b.height,b.depthTexture.needsUpdate=!0),ie?me(b.depthTexture,0):re(b.depthTexture,0);let de=ne.__webglTexture,j=bt(b),J=ie?i.TEXTURE_CUBE_MAP_POSITIVE_X+V:i.TEXTURE_2D,ce=b.depthTexture.format===qi?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(b.depthTexture.format===Ui)pe(b)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ce,J,de,0,j):i.framebufferTexture2D(i.FRAMEBUFFER,ce,J,de,0);else if(b.depthTexture.format===qi)pe(b)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ce,J,de,0,j):i.framebufferTexture2D(i.FRAMEBUFFER,ce,J,de,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function zn(E){let b=n.get(E),V=E.isWebGLCubeRenderTarget===!0;if(b.__boundDepthTexture!==E.depthTexture){let ie=E.depthTexture;if(b.__depthDisposeCallback&&b.__depthDisposeCallback(),ie){let ne=()=>{delete b.__boundDepthTexture,delete b.__depthDisposeCallback,ie.removeEventListener("dispose",ne)};ie.addEventListener("dispose",ne),b.__depthDisposeCallback=ne}b.__boundDepthTexture=ie}if(E.depthTexture&&!b.__autoAllocateDepthBuffer)if(V)for(let ie=0;ie<6;ie++)Ht(b.__webglFramebuffer[ie],E,ie);else E.texture.mipmaps.length>0?Ht(b.__webglFramebuffer[0],E,0):Ht(b.__webglFramebuffer,E,0);else if(V){b.__webglDepthbuffer=[];for(let ie=0;ie<6;ie++)if(t.bindFramebuffer(i.FRAMEBUFFER,b.__webglFramebuffer[ie]),b.__webglDepthbuffer[ie]===void 0)b.__webglDepthbuffer[ie]=i.createRenderbuffer(),pi(b.__webglDepthbuffer[ie],E,!1);else{let ne=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ae=b.__webglDepthbuffer[ie];i.bindRenderbuffer(i.RENDERBUFFER,ae),i.framebufferRenderbuffer(i.FRAMEBUFFER,ne,i.RENDERBUFFER,ae)}}else if(E.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,b.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,b.__webglFramebuffer),b.__webglDepthbuffer===void 0)b.__webglDepthbuffer=i.createRenderbuffer(),pi(b.__webglDepthbuffer,E,!1);else{let ne=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ae=b.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ae),i.framebufferRenderbuffer(i.FRAMEBUFFER,ne,i.RENDERBUFFER,ae)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function Vn(E,b,V){let ie=n.get(E);b!==void 0&&wt(ie.__webglFramebuffer,E,E.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),V!==void 0&&zn(E)}function Hn(E){let b=E.texture,V=n.get(E),ie=n.get(b);E.addEventListener("dispose",D),C(E);let ne=E.textures,ae=E.isWebGLCubeRenderTarget===!0,de=ne.length>1;if(de||(ie.__webglTexture===void 0&&(ie.__webglTexture=i.createTexture()),ie.__version=b.version,o.memory.textures++),ae){V.__webglFramebuffer=[];for(let j=0;j<6;j++)if(b.mipmaps.length>0){V.__webglFramebuffer[j]=[];for(let J=0;J<b.mipmaps.length;J++)V.__webglFramebuffer[j][J]=i.createFramebuffer()}else V.__webglFramebuffer[j]=i.createFramebuffer()}else{if(b.mipmaps.length>0){V.__webglFramebuffer=[];for(let j=0;j<b.mipmaps.length;j++)V.__webglFramebuffer[j]=i.createFramebuffer()}else V.__webglFramebuffer=i.createFramebuffer();if(de)for(let j=0,J=ne.length;j<J;j++){let ce=n.get(ne[j]);ce.__webglTexture===void 0&&(ce.__webglTexture=i.createTexture(),o.memory.textures++)}if(E.samples>0&&pe(E)===!1){V.__webglMultisampledFramebuffer=i.createFramebuffer(),V.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let j=0;j<ne.length;j++){let J=ne[j];V.__webglColorRenderbuffer[j]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,V.__webglColorRenderbuffer[j]);let ce=r.convert(J.format,J.colorSpace),L=r.convert(J.type),Z=w(J.internalFormat,ce,L,J.normalized,J.colorSpace,E.isXRRenderTarget===!0),K=bt(E);i.renderbufferStorageMultisample(i.RENDERBUFFER,K,Z,E.width,E.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+j,i.RENDERBUFFER,V.__webglColorRenderbuffer[j])}i.bindRenderbuffer(i.RENDERBUFFER,null),E.depthBuffer&&(V.__webglDepthRenderbuffer=i.createRenderbuffer(),pi(V.__webglDepthRenderbuffer,E,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(ae){t.bindTexture(i.TEXTURE_CUBE_MAP,ie.__webglTexture),nt(i.TEXTURE_CUBE_MAP,b);for(let j=0;j<6;j++)if(b.mipmaps.length>0)for(let J=0;J<b.mipmaps.length;J++)wt(V.__webglFramebuffer[j][J],E,b,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+j,J);else wt(V.__webglFramebuffer[j],E,b,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+j,0);M(b)?_(i.TEXTURE_CUBE_MAP):b.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),t.unbindTexture()}else if(de){for(let j=0,J=ne.length;j<J;j++){let ce=ne[j],L=n.get(ce),Z=i.TEXTURE_2D;(E.isWebGL3DRenderTarget||E.isWebGLArrayRenderTarget)&&(Z=E.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(Z,L.__webglTexture),nt(Z,ce),wt(V.__webglFramebuffer,E,ce,i.COLOR_ATTACHMENT0+j,Z,0),M(ce)&&_(Z)}t.unbindTexture()}else{let j=i.TEXTURE_2D;if((E.isWebGL3DRenderTarget||E.isWebGLArrayRenderTarget)&&(j=E.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(j,ie.__webglTexture),nt(j,b),b.mipmaps.length>0)for(let J=0;J<b.mipmaps.length;J++)wt(V.__webglFramebuffer[J],E,b,i.COLOR_ATTACHMENT0,j,J);else wt(V.__webglFramebuffer,E,b,i.COLOR_ATTACHMENT0,j,0);M(b)?_(j):b.mipmaps.length>0&&i.texParameteri(j,i.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),t.unbindTexture()}E.depthBuffer&&zn(E)}function O(E){let b=E.textures;for(let V=0,ie=b.length;V<ie;V++){let ne=b[V];if(M(ne)&&ne.mipmapsAutoUpdate===!0){let ae=T(E),de=n.get(ne).__webglTexture;t.bindTexture(ae,de),_(ae),t.unbindTexture()}}}let Gn=[];function _t(E){if(E.samples>0){if(pe(E)===!1){let b=E.textures,V=E.width,ie=E.height,ne=i.COLOR_BUFFER_BIT,ae=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,de=n.get(E),j=b.length>1;if(j)for(let ce=0;ce<b.length;ce++)t.bindFramebuffer(i.FRAMEBUFFER,de.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ce,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,de.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ce,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,de.__webglMultisampledFramebuffer),E.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,de.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,de.__webglFramebuffer);for(let ce=0;ce<b.length;ce++){if(E.resolveDepthBuffer&&(E.depthBuffer&&(ne|=i.DEPTH_BUFFER_BIT),E.stencilBuffer&&E.resolveStencilBuffer&&(ne|=i.STENCIL_BUFFER_BIT)),j){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,de.__webglColorRenderbuffer[ce]);let L=n.get(b[ce]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,L,0)}i.blitFramebuffer(0,0,V,ie,0,0,V,ie,ne,i.NEAREST),l===!0&&(Gn.length=0,Gn.push(i.COLOR_ATTACHMENT0+ce),E.depthBuffer&&E.storeMultisampledDepthBuffer===!1&&Gn.push(ae),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Gn))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),j)for(let ce=0;ce<b.length;ce++){t.bindFramebuffer(i.FRAMEBUFFER,de.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ce,i.RENDERBUFFER,de.__webglColorRenderbuffer[ce]);let L=n.get(b[ce]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,de.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ce,i.TEXTURE_2D,L,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,de.__webglMultisampledFramebuffer)}else if(E.depthBuffer&&E.storeMultisampledDepthBuffer===!1&&l){let b=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[b])}}}function bt(E){return Math.min(s.maxSamples,E.samples)}function pe(E){let b=n.get(E);return E.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&b.__useRenderToTexture!==!1}function Dt(E){let b=o.render.frame;h.get(E)!==b&&(h.set(E,b),E.update())}function Ne(E,b){let V=E.colorSpace,ie=E.format,ne=E.type;return E.isCompressedTexture===!0||E.isVideoTexture===!0||V!==pn&&V!==$i&&($e.getTransfer(V)===lt?(ie!==an||ne!==Rn)&&Re("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):De("WebGLTextures: Unsupported texture color space:",V)),b}function Fe(E){return typeof HTMLImageElement<"u"&&E instanceof HTMLImageElement?(c.width=E.naturalWidth||E.width,c.height=E.naturalHeight||E.height):typeof VideoFrame<"u"&&E instanceof VideoFrame?(c.width=E.displayWidth,c.height=E.displayHeight):(c.width=E.width,c.height=E.height),c}this.allocateTextureUnit=Ae,this.resetTextureUnits=ee,this.getTextureUnits=te,this.setTextureUnits=_e,this.setTexture2D=re,this.setTexture2DArray=ve,this.setTexture3D=Pe,this.setTextureCube=me,this.rebindTextures=Vn,this.setupRenderTarget=Hn,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=_t,this.setupDepthRenderbuffer=zn,this.setupFrameBufferTexture=wt,this.useMultisampledRTT=pe,this.dispose=G}function OS(i,e){function t(n,s=$i){let r,o=$e.getTransfer(s);if(n===Rn)return i.UNSIGNED_BYTE;if(n===wl)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Al)return i.UNSIGNED_SHORT_5_5_5_1;if(n===zu)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Vu)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===Bu)return i.BYTE;if(n===ku)return i.SHORT;if(n===zr)return i.UNSIGNED_SHORT;if(n===Sl)return i.INT;if(n===Cn)return i.UNSIGNED_INT;if(n===Jt)return i.FLOAT;if(n===hi)return i.HALF_FLOAT;if(n===Hu)return i.ALPHA;if(n===Gu)return i.RGB;if(n===an)return i.RGBA;if(n===Ui)return i.DEPTH_COMPONENT;if(n===qi)return i.DEPTH_STENCIL;if(n===Tl)return i.RED;if(n===El)return i.RED_INTEGER;if(n===xs)return i.RG;if(n===Rl)return i.RG_INTEGER;if(n===Vr)return i.RGBA_INTEGER;if(n===Xo||n===qo||n===$o||n===Yo)if(o===lt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Xo)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===qo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===$o)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Yo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Xo)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===qo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===$o)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Yo)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Cl||n===Pl||n===Il||n===Ll)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Cl)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Pl)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Il)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Ll)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Nl||n===Dl||n===Ul||n===Ol||n===Fl||n===Ko||n===Bl)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Nl||n===Dl)return o===lt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Ul)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Ol)return r.COMPRESSED_R11_EAC;if(n===Fl)return r.COMPRESSED_SIGNED_R11_EAC;if(n===Ko)return r.COMPRESSED_RG11_EAC;if(n===Bl)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===kl||n===zl||n===Vl||n===Hl||n===Gl||n===Wl||n===Xl||n===ql||n===$l||n===Yl||n===Kl||n===jl||n===Jl||n===Zl)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===kl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===zl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Vl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Hl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Gl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Wl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Xl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===ql)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===$l)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Yl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Kl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===jl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Jl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Zl)return o===lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Ql||n===ec||n===tc)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===Ql)return o===lt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===ec)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===tc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===nc||n===ic||n===jo||n===sc)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===nc)return r.COMPRESSED_RED_RGTC1_EXT;if(n===ic)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===jo)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===sc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Ys?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var FS=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,BS=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,dd=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new Io(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new An({vertexShader:FS,fragmentShader:BS,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new je(new fs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},fd=class extends oi{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,y=null,x=typeof XRWebGLBinding<"u",m=new dd,g={},S=t.getContextAttributes(),M=null,_=null,T=[],w=[],p=new Ee,v=null,C=null,R=new Ut;R.viewport=new it;let I=new Ut;I.viewport=new it;let D=[R,I],B=new vl,P=null,G=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(Y){let re=T[Y];return re===void 0&&(re=new Cr,T[Y]=re),re.getTargetRaySpace()},this.getControllerGrip=function(Y){let re=T[Y];return re===void 0&&(re=new Cr,T[Y]=re),re.getGripSpace()},this.getHand=function(Y){let re=T[Y];return re===void 0&&(re=new Cr,T[Y]=re),re.getHandSpace()};function W(Y){let re=w.indexOf(Y.inputSource);if(re===-1)return;let ve=T[re];ve!==void 0&&(ve.update(Y.inputSource,Y.frame,c||o),ve.dispatchEvent({type:Y.type,data:Y.inputSource}))}function k(){s.removeEventListener("select",W),s.removeEventListener("selectstart",W),s.removeEventListener("selectend",W),s.removeEventListener("squeeze",W),s.removeEventListener("squeezestart",W),s.removeEventListener("squeezeend",W),s.removeEventListener("end",k),s.removeEventListener("inputsourceschange",Q);for(let Y=0;Y<T.length;Y++){let re=w[Y];re!==null&&(w[Y]=null,T[Y].disconnect(re))}P=null,G=null,m.reset();for(let Y in g)delete g[Y];if(e.setRenderTarget(M),f=null,d=null,u=null,s=null,_=null,Ae.stop(),n.isPresenting=!1,e.setPixelRatio(v),e.setSize(p.width,p.height,!1),C!==null){let Y=C.camera;Y.fov=C.fov,Y.zoom=C.zoom,Y.updateProjectionMatrix(),C=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(Y){r=Y,n.isPresenting===!0&&Re("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(Y){a=Y,n.isPresenting===!0&&Re("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(Y){c=Y},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&x&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return y},this.getSession=function(){return s},this.setSession=async function(Y){if(s=Y,s!==null){if(M=e.getRenderTarget(),s.addEventListener("select",W),s.addEventListener("selectstart",W),s.addEventListener("selectend",W),s.addEventListener("squeeze",W),s.addEventListener("squeezestart",W),s.addEventListener("squeezeend",W),s.addEventListener("end",k),s.addEventListener("inputsourceschange",Q),S.xrCompatible!==!0&&await t.makeXRCompatible(),v=e.getPixelRatio(),e.getSize(p),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let ve=null,Pe=null,me=null;S.depth&&(me=S.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ve=S.stencil?qi:Ui,Pe=S.stencil?Ys:Cn);let Oe={colorFormat:t.RGBA8,depthFormat:me,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Oe),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),_=new mn(d.textureWidth,d.textureHeight,{format:an,type:Rn,depthTexture:new Fi(d.textureWidth,d.textureHeight,Pe,void 0,void 0,void 0,void 0,void 0,void 0,ve),stencilBuffer:S.stencil,colorSpace:e.outputColorSpace,samples:S.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let ve={antialias:S.antialias,alpha:!0,depth:S.depth,stencil:S.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ve),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),_=new mn(f.framebufferWidth,f.framebufferHeight,{format:an,type:Rn,colorSpace:e.outputColorSpace,stencilBuffer:S.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}_.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Ae.setContext(s),Ae.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function Q(Y){for(let re=0;re<Y.removed.length;re++){let ve=Y.removed[re],Pe=w.indexOf(ve);Pe>=0&&(w[Pe]=null,T[Pe].disconnect(ve))}for(let re=0;re<Y.added.length;re++){let ve=Y.added[re],Pe=w.indexOf(ve);if(Pe===-1){for(let Oe=0;Oe<T.length;Oe++)if(Oe>=w.length){w.push(ve),Pe=Oe;break}else if(w[Oe]===null){w[Oe]=ve,Pe=Oe;break}if(Pe===-1)break}let me=T[Pe];me&&me.connect(ve)}}function q(Y,re){re===null?Y.matrixWorld.copy(Y.matrix):Y.matrixWorld.multiplyMatrices(re.matrixWorld,Y.matrix),Y.matrixWorldInverse.copy(Y.matrixWorld).invert()}this.updateCamera=function(Y){if(s===null)return;let re=Y.near,ve=Y.far;m.texture!==null&&(m.depthNear>0&&(re=m.depthNear),m.depthFar>0&&(ve=m.depthFar)),B.near=I.near=R.near=re,B.far=I.far=R.far=ve,(P!==B.near||G!==B.far)&&(s.updateRenderState({depthNear:B.near,depthFar:B.far}),P=B.near,G=B.far),B.layers.mask=Y.layers.mask|6,R.layers.mask=B.layers.mask&-5,I.layers.mask=B.layers.mask&-3;let Pe=Y.parent,me=B.cameras;q(B,Pe);for(let Oe=0;Oe<me.length;Oe++)q(me[Oe],Pe);B.projectionMatrix.copy(R.projectionMatrix),B.projectionMatrixInverse.copy(R.projectionMatrixInverse),C===null&&Y.isPerspectiveCamera&&(C={camera:Y,fov:Y.fov,zoom:Y.zoom}),ee(Y,B,Pe)};function ee(Y,re,ve){ve===null?Y.matrix.copy(re.matrixWorld):(Y.matrix.copy(ve.matrixWorld),Y.matrix.invert(),Y.matrix.multiply(re.matrixWorld)),Y.matrix.decompose(Y.position,Y.quaternion,Y.scale),Y.updateMatrixWorld(!0),Y.projectionMatrix.copy(re.projectionMatrix),Y.projectionMatrixInverse.copy(re.projectionMatrixInverse),Y.isPerspectiveCamera&&(Y.fov=Os*2*Math.atan(1/Y.projectionMatrix.elements[5]),Y.zoom=1)}this.getCamera=function(){return B},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(Y){l=Y,d!==null&&(d.fixedFoveation=Y),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=Y)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(B)},this.getCameraTexture=function(Y){return g[Y]};let te=null;function _e(Y,re){if(h=re.getViewerPose(c||o),y=re,h!==null){let ve=h.views;f!==null&&(e.setRenderTargetFramebuffer(_,f.framebuffer),e.setRenderTarget(_));let Pe=!1;ve.length!==B.cameras.length&&(B.cameras.length=0,Pe=!0);for(let Le=0;Le<ve.length;Le++){let nt=ve[Le],st=null;if(f!==null)st=f.getViewport(nt);else{let $t=u.getViewSubImage(d,nt);st=$t.viewport,Le===0&&(e.setRenderTargetTextures(_,$t.colorTexture,$t.depthStencilTexture),e.setRenderTarget(_))}let We=D[Le];We===void 0&&(We=new Ut,We.layers.enable(Le),We.viewport=new it,D[Le]=We),We.matrix.fromArray(nt.transform.matrix),We.matrix.decompose(We.position,We.quaternion,We.scale),We.projectionMatrix.fromArray(nt.projectionMatrix),We.projectionMatrixInverse.copy(We.projectionMatrix).invert(),We.viewport.set(st.x,st.y,st.width,st.height),Le===0&&(B.matrix.copy(We.matrix),B.matrix.decompose(B.position,B.quaternion,B.scale)),Pe===!0&&B.cameras.push(We)}let me=s.enabledFeatures;if(me&&me.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&x){u=n.getBinding();let Le=u.getDepthInformation(ve[0]);Le&&Le.isValid&&Le.texture&&m.init(Le,s.renderState)}if(me&&me.includes("camera-access")&&x){e.state.unbindTexture(),u=n.getBinding();for(let Le=0;Le<ve.length;Le++){let nt=ve[Le].camera;if(nt){let st=g[nt];st||(st=new Io,g[nt]=st);let We=u.getCameraImage(nt);st.sourceTexture=We}}}}for(let ve=0;ve<T.length;ve++){let Pe=w[ve],me=T[ve];Pe!==null&&me!==void 0&&me.update(Pe,re,c||o)}te&&te(Y,re),re.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:re}),y=null}let Ae=new Qm;Ae.setAnimationLoop(_e),this.setAnimationLoop=function(Y){te=Y},this.dispose=function(){}}},kS=new ke,cg=new Ue;cg.set(-1,0,0,0,1,0,0,0,1);function zS(i,e){function t(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function n(m,g){g.color.getRGB(m.fogColor.value,ed(i)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function s(m,g,S,M,_){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(m,g):g.isMeshLambertMaterial?(r(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(m,g),u(m,g)):g.isMeshPhongMaterial?(r(m,g),h(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(m,g),d(m,g),g.isMeshPhysicalMaterial&&f(m,g,_)):g.isMeshMatcapMaterial?(r(m,g),y(m,g)):g.isMeshDepthMaterial?r(m,g):g.isMeshDistanceMaterial?(r(m,g),x(m,g)):g.isMeshNormalMaterial?r(m,g):g.isLineBasicMaterial?(o(m,g),g.isLineDashedMaterial&&a(m,g)):g.isPointsMaterial?l(m,g,S,M):g.isSpriteMaterial?c(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,t(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,t(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===jt&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,t(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===jt&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,t(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,t(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,t(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let S=e.get(g),M=S.envMap,_=S.envMapRotation;M&&(m.envMap.value=M,m.envMapRotation.value.setFromMatrix4(kS.makeRotationFromEuler(_)).transpose(),M.isCubeTexture&&M.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(cg),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,t(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,t(g.aoMap,m.aoMapTransform))}function o(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,t(g.map,m.mapTransform))}function a(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function l(m,g,S,M){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*S,m.scale.value=M*.5,g.map&&(m.map.value=g.map,t(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function c(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,t(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function h(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function u(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function d(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,t(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,t(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function f(m,g,S){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,t(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,t(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,t(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,t(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,t(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,t(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===jt&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,t(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,t(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=S.texture,m.transmissionSamplerSize.value.set(S.width,S.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,t(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,t(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,t(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,t(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,t(g.specularIntensityMap,m.specularIntensityMapTransform))}function y(m,g){g.matcap&&(m.matcap.value=g.matcap)}function x(m,g){let S=e.get(g).light;m.referencePosition.value.setFromMatrixPosition(S.matrixWorld),m.nearDistance.value=S.shadow.camera.near,m.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function VS(i,e,t,n){let s={},r={};function o(S,M){let _=M.program;n.uniformBlockBinding(S,_,s[S.id])}function a(S,M){let _=s[S.id];_===void 0&&(y(S),_=l(S),s[S.id]=_,S.addEventListener("dispose",m));let T=M.program;n.updateUBOMapping(S,T);let w=e.render.frame;r[S.id]!==w&&(c(S),r[S.id]=w)}function l(S){let M=i.createBuffer(),_=S.__size,T=S.usage;return i.bindBuffer(i.UNIFORM_BUFFER,M),i.bufferData(i.UNIFORM_BUFFER,_,T),i.bindBuffer(i.UNIFORM_BUFFER,null),M}function c(S){let M=s[S.id],_=S.uniforms,T=S.__cache;i.bindBuffer(i.UNIFORM_BUFFER,M);for(let w=0,p=_.length;w<p;w++){let v=_[w];if(Array.isArray(v))for(let C=0,R=v.length;C<R;C++)h(v[C],w,C,T);else h(v,w,0,T)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(S,M,_,T){if(d(S,M,_,T)===!0){let w=S.__offset,p=S.value;if(Array.isArray(p)){let v=0;for(let C=0;C<p.length;C++){let R=p[C],I=x(R,!0);u(R,S.__data,v),v+=I.storage/Float32Array.BYTES_PER_ELEMENT}}else u(p,S.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,w,S.__data)}}function u(S,M,_){typeof S=="number"||typeof S=="boolean"?M[_]=S:S.isMatrix3?(M[_]=S.elements[0],M[_+1]=S.elements[1],M[_+2]=S.elements[2],M[_+3]=0,M[_+4]=S.elements[3],M[_+5]=S.elements[4],M[_+6]=S.elements[5],M[_+7]=0,M[_+8]=S.elements[6],M[_+9]=S.elements[7],M[_+10]=S.elements[8],M[_+11]=0):ArrayBuffer.isView(S)?M.set(S.subarray(0,M.length-_),_):S.toArray(M,_)}function d(S,M,_,T){let w=S.value,p=M+"_"+_;if(Array.isArray(w)){T[p]===void 0&&(T[p]=[]);let v=T[p],C=!1;for(let R=0;R<w.length;R++)f(w[R],v,R)===!0&&(C=!0);return C}return f(w,T,p)}function f(S,M,_){if(M[_]===void 0)return typeof S=="number"||typeof S=="boolean"?M[_]=S:ArrayBuffer.isView(S)?M[_]=S.slice():M[_]=S.clone(),!0;{let T=M[_];if(typeof S=="number"||typeof S=="boolean"){if(T!==S)return M[_]=S,!0}else{if(ArrayBuffer.isView(S))return!0;if(T.equals(S)===!1)return T.copy(S),!0}}return!1}function y(S){let M=S.uniforms,_=0,T=16;for(let p=0,v=M.length;p<v;p++){let C=Array.isArray(M[p])?M[p]:[M[p]];for(let R=0,I=C.length;R<I;R++){let D=C[R],B=Array.isArray(D.value)?D.value:[D.value],P=Array.isArray(M[p])||Array.isArray(D.value),G=_;for(let k=0,Q=B.length;k<Q;k++){let q=B[k],ee=x(q,P),te=_%T,_e=te%ee.boundary,Ae=te+_e;_+=_e,Ae!==0&&T-Ae<ee.storage&&(_+=T-Ae),k===0&&(G=_),_+=ee.storage}let W=D.type==="int"?Int32Array:D.type==="uint"?Uint32Array:Float32Array;D.__data=new W((_-G)/Float32Array.BYTES_PER_ELEMENT),D.__offset=G}}let w=_%T;return w>0&&(_+=T-w),S.__size=_,S.__cache={},this}function x(S,M){let _={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(_.boundary=4,_.storage=4):S.isVector2?(_.boundary=8,_.storage=8):S.isVector3||S.isColor?(_.boundary=16,_.storage=12):S.isVector4?(_.boundary=16,_.storage=16):S.isMatrix3?(_.boundary=16,_.storage=48):S.isMatrix4?(_.boundary=16,_.storage=64):S.isTexture?Re("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(S)?(_.boundary=16,_.storage=S.byteLength):Re("WebGLRenderer: Unsupported uniform value type.",S),M===!0&&(_.boundary=16,_.storage=Math.ceil(_.storage/16)*16),_}function m(S){let M=S.target;M.removeEventListener("dispose",m),i.deleteBuffer(s[M.id]),delete s[M.id],delete r[M.id]}function g(){for(let S in s)i.deleteBuffer(s[S]);s={},r={}}return{bind:o,update:a,dispose:g}}var HS=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Mi=null;function GS(){return Mi===null&&(Mi=new Fn(HS,16,16,xs,hi),Mi.name="DFG_LUT",Mi.minFilter=Ot,Mi.magFilter=Ot,Mi.wrapS=Xn,Mi.wrapT=Xn,Mi.generateMipmaps=!1,Mi.needsUpdate=!0),Mi}var $r=class{constructor(e={}){let{canvas:t=wm(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=Rn}=e;this.isWebGLRenderer=!0;let y;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");y=n.getContextAttributes().alpha}else y=o;let x=f,m=new Set([Vr,Rl,El]),g=new Set([Rn,Cn,zr,Ys,wl,Al]),S=new Uint32Array(4),M=new Int32Array(4),_={textures:[],min:[],max:[],resolution:[]},T=null,w=null,p=[],v=[],C=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=_i,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let R=this,I=!1,D=null,B=null,P=null,G=null;this._outputColorSpace=dt;let W=0,k=0,Q=null,q=-1,ee=null,te=new it,_e=new it,Ae=null,Y=new be(0),re=0,ve=t.width,Pe=t.height,me=1,Oe=null,St=null,Le=new it(0,0,ve,Pe),nt=new it(0,0,ve,Pe),st=!1,We=new us,$t=new al,Nt=!1,Mn=!1,wt=new ke,pi=new U,Ht=new it,zn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Vn=!1;function Hn(){return Q===null?me:1}let O=n;function Gn(A,N){return t.getContext(A,N)}let _t,bt,pe,Dt,Ne,Fe,E,b,V,ie,ne,ae,de,j,J,ce,L,Z,K,he,oe,le,Ce;try{let A={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Ie,!1),t.addEventListener("webglcontextrestored",He,!1),t.addEventListener("webglcontextcreationerror",ge,!1),O===null){let N="webgl2";if(O=Gn(N,A),O===null)throw Gn(N)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Xe()}catch(A){throw t.removeEventListener("webglcontextlost",Ie,!1),t.removeEventListener("webglcontextrestored",He,!1),t.removeEventListener("webglcontextcreationerror",ge,!1),De("WebGLRenderer: "+A.message),A}function Xe(){_t=new eM(O),_t.init(),oe=new OS(O,_t),bt=new Gb(O,_t,e,oe),pe=new DS(O,_t),bt.reversedDepthBuffer&&d&&pe.buffers.depth.setReversed(!0),B=O.createFramebuffer(),P=O.createFramebuffer(),G=O.createFramebuffer(),Dt=new iM(O),Ne=new _S,Fe=new US(O,_t,pe,Ne,bt,oe,Dt),E=new Qb(R),b=new rv(O),le=new Vb(O,b),V=new tM(O,b,Dt,le),ie=new rM(O,V,b,le,Dt),Z=new sM(O,bt,Fe),J=new Wb(Ne),ne=new vS(R,E,_t,bt,le,J),ae=new zS(R,Ne),de=new MS,j=new RS(_t),L=new zb(R,E,pe,ie,y,l),ce=new NS(R,ie,bt),Ce=new VS(O,Dt,bt,pe),K=new Hb(O,_t,Dt),he=new nM(O,_t,Dt),Dt.programs=ne.programs,R.capabilities=bt,R.extensions=_t,R.properties=Ne,R.renderLists=de,R.shadowMap=ce,R.state=pe,R.info=Dt}x!==Rn&&(C=new aM(x,t.width,t.height,a,s,r));let se=new fd(R,O);this.xr=se,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let A=_t.get("WEBGL_lose_context");A&&A.loseContext()},this.forceContextRestore=function(){let A=_t.get("WEBGL_lose_context");A&&A.restoreContext()},this.getPixelRatio=function(){return me},this.setPixelRatio=function(A){A!==void 0&&(me=A,this.setSize(ve,Pe,!1))},this.getSize=function(A){return A.set(ve,Pe)},this.setSize=function(A,N,X=!0){if(se.isPresenting){Re("WebGLRenderer: Can't change size while VR device is presenting.");return}ve=A,Pe=N,t.width=Math.floor(A*me),t.height=Math.floor(N*me),X===!0&&(t.style.width=A+"px",t.style.height=N+"px"),C!==null&&C.setSize(t.width,t.height),this.setViewport(0,0,A,N)},this.getDrawingBufferSize=function(A){return A.set(ve*me,Pe*me).floor()},this.setDrawingBufferSize=function(A,N,X){ve=A,Pe=N,me=X,t.width=Math.floor(A*X),t.height=Math.floor(N*X),this.setViewport(0,0,A,N)},this.setEffects=function(A){if(x===Rn){De("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(A){for(let N=0;N<A.length;N++)if(A[N].isOutputPass===!0){Re("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}C.setEffects(A||[])},this.getCurrentViewport=function(A){return A.copy(te)},this.getViewport=function(A){return A.copy(Le)},this.setViewport=function(A,N,X,z){A.isVector4?Le.set(A.x,A.y,A.z,A.w):Le.set(A,N,X,z),pe.viewport(te.copy(Le).multiplyScalar(Hn()).round())},this.getScissor=function(A){return A.copy(nt)},this.setScissor=function(A,N,X,z){A.isVector4?nt.set(A.x,A.y,A.z,A.w):nt.set(A,N,X,z),pe.scissor(_e.copy(nt).multiplyScalar(Hn()).round())},this.getScissorTest=function(){return st},this.setScissorTest=function(A){pe.setScissorTest(st=A)},this.setOpaqueSort=function(A){Oe=A},this.setTransparentSort=function(A){St=A},this.getClearColor=function(A){return A.copy(L.getClearColor())},this.setClearColor=function(){L.setClearColor(...arguments)},this.getClearAlpha=function(){return L.getClearAlpha()},this.setClearAlpha=function(){L.setClearAlpha(...arguments)},this.clear=function(A=!0,N=!0,X=!0){let z=0;if(A){let H=!1;if(Q!==null){let fe=Q.texture.format;H=m.has(fe)}if(H){let fe=Q.texture.type,Me=g.has(fe),ue=L.getClearColor(),xe=L.getClearAlpha(),Te=ue.r,Be=ue.g,Ze=ue.b;Me?(S[0]=Te,S[1]=Be,S[2]=Ze,S[3]=xe,O.clearBufferuiv(O.COLOR,0,S)):(M[0]=Te,M[1]=Be,M[2]=Ze,M[3]=xe,O.clearBufferiv(O.COLOR,0,M))}else z|=O.COLOR_BUFFER_BIT}N&&(z|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),X&&(z|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),z!==0&&O.clear(z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(A){A.setRenderer(this),D=A},this.dispose=function(){t.removeEventListener("webglcontextlost",Ie,!1),t.removeEventListener("webglcontextrestored",He,!1),t.removeEventListener("webglcontextcreationerror",ge,!1),L.dispose(),de.dispose(),j.dispose(),Fe.dispose(),Ne.dispose(),E.dispose(),ie.dispose(),V.dispose(),le.dispose(),Ce.dispose(),ne.dispose(),se.dispose(),se.removeEventListener("sessionstart",Wf),se.removeEventListener("sessionend",Xf),Ts.stop()};function Ie(A){A.preventDefault(),_o("WebGLRenderer: Context Lost."),I=!0}function He(){_o("WebGLRenderer: Context Restored."),I=!1;let A=Dt.autoReset,N=ce.enabled,X=ce.autoUpdate,z=ce.needsUpdate,H=ce.type;Xe(),Dt.autoReset=A,ce.enabled=N,ce.autoUpdate=X,ce.needsUpdate=z,ce.type=H}function ge(A){De("WebGLRenderer: A WebGL context could not be created. Reason: ",A.statusMessage)}function ht(A){let N=A.target;N.removeEventListener("dispose",ht),Gt(N)}function Gt(A){ns(A),Ne.remove(A)}function ns(A){let N=Ne.get(A).programs;N!==void 0&&(N.forEach(function(X){ne.releaseProgram(X)}),A.isShaderMaterial&&ne.releaseShaderCache(A))}this.renderBufferDirect=function(A,N,X,z,H,fe){N===null&&(N=zn);let Me=H.isMesh&&H.matrixWorld.determinantAffine()<0,ue=Jy(A,N,X,z,H);pe.setMaterial(z,Me);let xe=X.index,Te=1;if(z.wireframe===!0){if(xe=V.getWireframeAttribute(X),xe===void 0)return;Te=2}let Be=X.drawRange,Ze=X.attributes.position,Se=Be.start*Te,Qe=(Be.start+Be.count)*Te;fe!==null&&(Se=Math.max(Se,fe.start*Te),Qe=Math.min(Qe,(fe.start+fe.count)*Te)),xe!==null?(Se=Math.max(Se,0),Qe=Math.min(Qe,xe.count)):Ze!=null&&(Se=Math.max(Se,0),Qe=Math.min(Qe,Ze.count));let Ct=Qe-Se;if(Ct<0||Ct===1/0)return;le.setup(H,z,ue,X,xe);let yt,pt=K;if(xe!==null&&(yt=b.get(xe),pt=he,pt.setIndex(yt)),H.isMesh)z.wireframe===!0?(pe.setLineWidth(z.wireframeLinewidth*Hn()),pt.setMode(O.LINES)):pt.setMode(O.TRIANGLES);else if(H.isLine){let Qt=z.linewidth;Qt===void 0&&(Qt=1),pe.setLineWidth(Qt*Hn()),H.isLineSegments?pt.setMode(O.LINES):H.isLineLoop?pt.setMode(O.LINE_LOOP):pt.setMode(O.LINE_STRIP)}else H.isPoints?pt.setMode(O.POINTS):H.isSprite&&pt.setMode(O.TRIANGLES);if(H.isBatchedMesh)if(_t.get("WEBGL_multi_draw"))pt.renderMultiDraw(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount);else{let Qt=H._multiDrawStarts,we=H._multiDrawCounts,dn=H._multiDrawCount,rt=xe?b.get(xe).bytesPerElement:1,Es=Ne.get(z).currentProgram.getUniforms();for(let en=0;en<dn;en++)Es.setValue(O,"_gl_DrawID",en),pt.render(Qt[en]/rt,we[en])}else if(H.isInstancedMesh)pt.renderInstances(Se,Ct,H.count);else if(X.isInstancedBufferGeometry){let Qt=X._maxInstanceCount!==void 0?X._maxInstanceCount:1/0,we=Math.min(X.instanceCount,Qt);pt.renderInstances(Se,Ct,we)}else pt.render(Se,Ct)};function Gf(A,N,X,z){D!==null&&A.isNodeMaterial&&D.setObject(z,A),Nt===!0&&J.setState(A,X,!1),A.transparent===!0&&A.side===Lt&&A.forceSinglePass===!1?(A.side=jt,A.needsUpdate=!0,io(A,N,z),A.side=vi,A.needsUpdate=!0,io(A,N,z),A.side=Lt):io(A,N,z)}this.compile=function(A,N,X=null){X===null&&(X=A),D!==null&&D.renderStart(A,N,X),w=j.get(X),w.init(N),v.push(w),X.traverseVisible(function(H){H.isLight&&H.layers.test(N.layers)&&(w.pushLight(H),H.castShadow&&w.pushShadow(H))}),A!==X&&A.traverseVisible(function(H){H.isLight&&H.layers.test(N.layers)&&(w.pushLight(H),H.castShadow&&w.pushShadow(H))}),w.setupLights(),D!==null&&D.updateLights(w.state.lightsArray),Mn=this.localClippingEnabled,Nt=J.init(this.clippingPlanes,Mn),Nt===!0&&J.setGlobalState(this.clippingPlanes,N),D!==null&&ce.render(w.state.shadowsArray,X,N);let z=new Set;return A.traverse(function(H){if(!(H.isMesh||H.isPoints||H.isLine||H.isSprite))return;let fe=H.material;if(fe)if(Array.isArray(fe))for(let Me=0;Me<fe.length;Me++){let ue=fe[Me];Gf(ue,X,N,H),z.add(ue)}else Gf(fe,X,N,H),z.add(fe)}),w=v.pop(),D!==null&&D.renderEnd(),z},this.compileAsync=function(A,N,X=null){let z=this.compile(A,N,X);return new Promise(H=>{function fe(){if(z.forEach(function(Me){let xe=Ne.get(Me).currentProgram;(xe===void 0||xe.isReady())&&z.delete(Me)}),z.size===0){H(A);return}setTimeout(fe,10)}_t.get("KHR_parallel_shader_compile")!==null?fe():setTimeout(fe,10)})};let Uh=null;function Ky(A){Uh&&Uh(A)}function Wf(){Ts.stop()}function Xf(){Ts.start()}let Ts=new Qm;Ts.setAnimationLoop(Ky),typeof self<"u"&&Ts.setContext(self),this.setAnimationLoop=function(A){Uh=A,se.setAnimationLoop(A),A===null?Ts.stop():Ts.start()},se.addEventListener("sessionstart",Wf),se.addEventListener("sessionend",Xf),this.render=function(A,N){if(N!==void 0&&N.isCamera!==!0){De("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(I===!0)return;D!==null&&D.renderStart(A,N);let X=se.enabled===!0&&se.isPresenting===!0,z=C!==null&&(Q===null||X)&&C.begin(R,Q);if(A.matrixWorldAutoUpdate===!0&&A.updateMatrixWorld(),N.parent===null&&N.matrixWorldAutoUpdate===!0&&N.updateMatrixWorld(),se.enabled===!0&&se.isPresenting===!0&&(C===null||C.isCompositing()===!1)&&(se.cameraAutoUpdate===!0&&se.updateCamera(N),N=se.getCamera()),A.isScene===!0&&A.onBeforeRender(R,A,N,Q),w=j.get(A,v.length),w.init(N),w.state.textureUnits=Fe.getTextureUnits(),v.push(w),wt.multiplyMatrices(N.projectionMatrix,N.matrixWorldInverse),N.isArrayCamera?$t.setFromArrayCamera(N):We.setFromProjectionMatrix(wt,qn,N.reversedDepth),Mn=this.localClippingEnabled,Nt=J.init(this.clippingPlanes,Mn),T=de.get(A,p.length),T.init(),p.push(T),this.info.render.frame++,se.enabled===!0&&se.isPresenting===!0){let Me=R.xr.getDepthSensingMesh();Me!==null&&Oh(Me,N,-1/0,R.sortObjects)}Oh(A,N,0,R.sortObjects),T.finish(),D!==null&&D.updateLights(w.state.lightsArray),R.sortObjects===!0&&T.sort(Oe,St),Vn=se.enabled===!1||se.isPresenting===!1||se.hasDepthSensing()===!1,Vn&&L.addToRenderList(T,A),this.info.autoReset===!0&&this.info.reset(),Nt===!0&&J.beginShadows();let H=w.state.shadowsArray;if(ce.render(H,A,N),Nt===!0&&J.endShadows(),(z&&C.hasRenderPass())===!1){let Me=T.opaque,ue=T.transmissive;if(w.setupLights(),N.isArrayCamera){let xe=N.cameras;if(ue.length>0)for(let Te=0,Be=xe.length;Te<Be;Te++){let Ze=xe[Te];$f(Me,ue,A,Ze)}Vn&&L.render(A);for(let Te=0,Be=xe.length;Te<Be;Te++){let Ze=xe[Te];qf(T,A,Ze,Ze.viewport)}}else ue.length>0&&$f(Me,ue,A,N),Vn&&L.render(A),qf(T,A,N)}Q!==null&&k===0&&(Fe.updateMultisampleRenderTarget(Q),Fe.updateRenderTargetMipmap(Q)),z&&C.end(R),A.isScene===!0&&A.onAfterRender(R,A,N),le.resetDefaultState(),q=-1,ee=null,v.pop(),v.length>0?(w=v[v.length-1],Fe.setTextureUnits(w.state.textureUnits),Nt===!0&&J.setGlobalState(R.clippingPlanes,w.state.camera)):w=null,p.pop(),p.length>0?T=p[p.length-1]:T=null,D!==null&&D.renderEnd()};function Oh(A,N,X,z){if(A.visible===!1)return;if(A.layers.test(N.layers)){if(A.isGroup)X=A.renderOrder;else if(A.isLOD)A.autoUpdate===!0&&A.update(N);else if(A.isLight)w.pushLight(A),A.castShadow&&w.pushShadow(A);else if(A.isSprite){let Me=N.isArrayCamera?$t:We;if(!A.frustumCulled||A.intersectsFrustum(Me)){z&&Ht.setFromMatrixPosition(A.matrixWorld).applyMatrix4(wt);let ue=ie.update(A),xe=A.material;xe.visible&&T.push(A,ue,xe,X,Ht.z,null,N)}}else if(A.isMesh||A.isLine||A.isPoints){let Me=N.isArrayCamera?$t:We;if(!A.frustumCulled||A.intersectsFrustum(Me)){let ue=ie.update(A),xe=A.material;if(z&&(A.boundingSphere!==void 0?(A.boundingSphere===null&&A.computeBoundingSphere(),Ht.copy(A.boundingSphere.center)):(ue.boundingSphere===null&&ue.computeBoundingSphere(),Ht.copy(ue.boundingSphere.center)),Ht.applyMatrix4(A.matrixWorld).applyMatrix4(wt)),Array.isArray(xe)){let Te=ue.groups;for(let Be=0,Ze=Te.length;Be<Ze;Be++){let Se=Te[Be],Qe=xe[Se.materialIndex];Qe&&Qe.visible&&T.push(A,ue,Qe,X,Ht.z,Se,N)}}else xe.visible&&T.push(A,ue,xe,X,Ht.z,null,N)}}}let fe=A.children;for(let Me=0,ue=fe.length;Me<ue;Me++)Oh(fe[Me],N,X,z)}function qf(A,N,X,z){let{opaque:H,transmissive:fe,transparent:Me}=A;w.setupLightsView(X),Nt===!0&&J.setGlobalState(R.clippingPlanes,X),z&&pe.viewport(te.copy(z)),H.length>0&&Ma(H,N,X),fe.length>0&&Ma(fe,N,X),Me.length>0&&Ma(Me,N,X),pe.buffers.depth.setTest(!0),pe.buffers.depth.setMask(!0),pe.buffers.color.setMask(!0),pe.setPolygonOffset(!1)}function $f(A,N,X,z){if((X.isScene===!0?X.overrideMaterial:null)!==null)return;if(w.state.transmissionRenderTarget[z.id]===void 0){let Se=_t.has("EXT_color_buffer_half_float")||_t.has("EXT_color_buffer_float");w.state.transmissionRenderTarget[z.id]=new mn(1,1,{generateMipmaps:!0,type:Se?hi:Rn,minFilter:Kn,samples:Math.max(4,bt.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:$e.workingColorSpace})}let fe=w.state.transmissionRenderTarget[z.id],Me=z.viewport||te;fe.setSize(Me.z*R.transmissionResolutionScale,Me.w*R.transmissionResolutionScale);let ue=R.getRenderTarget(),xe=R.getActiveCubeFace(),Te=R.getActiveMipmapLevel();R.setRenderTarget(fe),R.getClearColor(Y),re=R.getClearAlpha(),re<1&&R.setClearColor(16777215,.5),R.clear(),Vn&&L.render(X);let Be=R.toneMapping;R.toneMapping=_i;let Ze=z.viewport;if(z.viewport!==void 0&&(z.viewport=void 0),w.setupLightsView(z),Nt===!0&&J.setGlobalState(R.clippingPlanes,z),Ma(A,X,z),Fe.updateMultisampleRenderTarget(fe),Fe.updateRenderTargetMipmap(fe),_t.has("WEBGL_multisampled_render_to_texture")===!1){let Se=!1;for(let Qe=0,Ct=N.length;Qe<Ct;Qe++){let yt=N[Qe],{object:pt,geometry:Qt,material:we,group:dn}=yt;if(we.side===Lt&&pt.layers.test(z.layers)){let rt=we.side;we.side=jt,we.needsUpdate=!0,Yf(pt,X,z,Qt,we,dn),we.side=rt,we.needsUpdate=!0,Se=!0}}Se===!0&&(Fe.updateMultisampleRenderTarget(fe),Fe.updateRenderTargetMipmap(fe))}R.setRenderTarget(ue,xe,Te),R.setClearColor(Y,re),Ze!==void 0&&(z.viewport=Ze),R.toneMapping=Be}function Ma(A,N,X){let z=N.isScene===!0?N.overrideMaterial:null;for(let H=0,fe=A.length;H<fe;H++){let Me=A[H],{object:ue,geometry:xe,group:Te}=Me,Be=Me.material;Be.allowOverride===!0&&z!==null&&(Be=z),ue.layers.test(X.layers)&&Yf(ue,N,X,xe,Be,Te)}}function Yf(A,N,X,z,H,fe){D!==null&&H.isNodeMaterial&&D.setObject(A,H),A.onBeforeRender(R,N,X,z,H,fe),A.modelViewMatrix.multiplyMatrices(X.matrixWorldInverse,A.matrixWorld),A.normalMatrix.getNormalMatrix(A.modelViewMatrix),H.onBeforeRender(R,N,X,z,A,fe),H.transparent===!0&&H.side===Lt&&H.forceSinglePass===!1?(H.side=jt,H.needsUpdate=!0,R.renderBufferDirect(X,N,z,H,A,fe),H.side=vi,H.needsUpdate=!0,R.renderBufferDirect(X,N,z,H,A,fe),H.side=Lt):R.renderBufferDirect(X,N,z,H,A,fe),A.onAfterRender(R,N,X,z,H,fe)}function Kf(A){let N=0;for(let X of A)X.texture!==null&&N++;return N}function io(A,N,X){N.isScene!==!0&&(N=zn);let z=Ne.get(A),H=w.state.lights,fe=w.state.shadowsArray,Me=H.state.version,ue=ne.getParameters(A,H.state,fe,N,X,w.state.lightProbeGridArray),xe=ne.getProgramCacheKey(ue),Te=z.programs;z.environment=A.isMeshStandardMaterial||A.isMeshLambertMaterial||A.isMeshPhongMaterial?N.environment:null,z.fog=N.fog;let Be=A.isMeshStandardMaterial||A.isMeshLambertMaterial&&!A.envMap||A.isMeshPhongMaterial&&!A.envMap;z.envMap=E.get(A.envMap||z.environment,Be),z.envMapRotation=z.environment!==null&&A.envMap===null?N.environmentRotation:A.envMapRotation,Te===void 0&&(A.addEventListener("dispose",ht),Te=new Map,z.programs=Te,z.programVariants=new Map);let Ze=Te.get(xe);if(Ze!==void 0){if(z.currentProgram===Ze&&z.lightsStateVersion===Me)return Jf(A,ue),Ze}else ue.uniforms=ne.getUniforms(A),D!==null&&A.isNodeMaterial&&D.build(A,X,ue),A.onBeforeCompile(ue,R),Ze=ne.acquireProgram(ue,xe),Te.set(xe,Ze),z.uniforms=ue.uniforms;let Se=z.uniforms;return(!A.isShaderMaterial&&!A.isRawShaderMaterial||A.clipping===!0)&&(Se.clippingPlanes=J.uniform),Jf(A,ue),z.needsLights=Qy(A),z.lightsStateVersion=Me,z.needsLights&&(Se.ambientLightColor.value=H.state.ambient,Se.lightProbe.value=H.state.probe,Se.sunLights.value=H.state.sun,Se.sunLightShadows.value=H.state.sunShadow,Se.directionalLights.value=H.state.directional,Se.directionalLightShadows.value=H.state.directionalShadow,Se.spotLights.value=H.state.spot,Se.spotLightShadows.value=H.state.spotShadow,Se.rectAreaLights.value=H.state.rectArea,Se.ltc_1.value=H.state.rectAreaLTC1,Se.ltc_2.value=H.state.rectAreaLTC2,Se.pointLights.value=H.state.point,Se.pointLightShadows.value=H.state.pointShadow,Se.hemisphereLights.value=H.state.hemi,Se.sunShadowMatrix.value=H.state.sunShadowMatrix,Se.sunShadowCascade.value=H.state.sunShadowCascade,Se.directionalShadowMatrix.value=H.state.directionalShadowMatrix,Se.spotLightMatrix.value=H.state.spotLightMatrix,Se.spotLightMap.value=H.state.spotLightMap,Se.pointShadowMatrix.value=H.state.pointShadowMatrix),z.numLightProbeGrids=Kf(w.state.lightProbeGridArray),z.currentProgram=Ze,z.uniformsList=null,Ze}function jy(A,N,X,z,H){let fe=Ne.get(A),Me=fe.currentProgram.id+","+z+","+H,ue=fe.programVariants.get(Me);return ue===void 0?(ue=io(A,N,X),fe.programVariants.set(Me,ue)):(fe.currentProgram=ue,fe.uniformsList=null,fe.outputColorSpace=z,fe.toneMapping=H),ue}function jf(A){if(A.uniformsList===null){let N=A.currentProgram.getUniforms();A.uniformsList=Xr.seqWithValue(N.seq,A.uniforms)}return A.uniformsList}function Jf(A,N){let X=Ne.get(A);X.outputColorSpace=N.outputColorSpace,X.batching=N.batching,X.batchingColor=N.batchingColor,X.instancing=N.instancing,X.instancingColor=N.instancingColor,X.instancingMorph=N.instancingMorph,X.skinning=N.skinning,X.morphTargets=N.morphTargets,X.morphNormals=N.morphNormals,X.morphColors=N.morphColors,X.morphTargetsCount=N.morphTargetsCount,X.numClippingPlanes=N.numClippingPlanes,X.numIntersection=N.numClipIntersection,X.vertexAlphas=N.vertexAlphas,X.vertexTangents=N.vertexTangents,X.toneMapping=N.toneMapping}function Jy(A,N,X,z,H){N.isScene!==!0&&(N=zn),Fe.resetTextureUnits();let fe=N.fog,Me=z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial?N.environment:null,ue=Q===null?R.outputColorSpace:Q.isXRRenderTarget===!0?Q.texture.colorSpace:$e.workingColorSpace,xe=z.isMeshStandardMaterial||z.isMeshLambertMaterial&&!z.envMap||z.isMeshPhongMaterial&&!z.envMap,Te=E.get(z.envMap||Me,xe),Be=z.vertexColors===!0&&!!X.attributes.color&&X.attributes.color.itemSize===4,Ze=!!X.attributes.tangent&&(!!z.normalMap||z.anisotropy>0),Se=!!X.morphAttributes.position,Qe=!!X.morphAttributes.normal,Ct=!!X.morphAttributes.color,yt=_i;z.toneMapped&&(Q===null||Q.isXRRenderTarget===!0)&&(yt=R.toneMapping);let pt=X.morphAttributes.position||X.morphAttributes.normal||X.morphAttributes.color,Qt=pt!==void 0?pt.length:0,we=Ne.get(z),dn=w.state.lights;if(Nt===!0&&(Mn===!0||A!==ee)){let At=A===ee&&z.id===q;J.setState(z,A,At)}let rt=!1,Es=!1;z.version===we.__version?we.needsLights&&we.lightsStateVersion!==dn.state.version||H.isBatchedMesh&&we.batching===!1||!H.isBatchedMesh&&we.batching===!0||H.isBatchedMesh&&we.batchingColor===!0&&H._colorsTexture===null||H.isBatchedMesh&&we.batchingColor===!1&&H._colorsTexture!==null||H.isInstancedMesh&&we.instancing===!1||!H.isInstancedMesh&&we.instancing===!0||H.isSkinnedMesh&&we.skinning===!1||!H.isSkinnedMesh&&we.skinning===!0||H.isInstancedMesh&&we.instancingColor===!0&&H.instanceColor===null||H.isInstancedMesh&&we.instancingColor===!1&&H.instanceColor!==null||H.isInstancedMesh&&we.instancingMorph===!0&&H.morphTexture===null||H.isInstancedMesh&&we.instancingMorph===!1&&H.morphTexture!==null||we.envMap!==Te||z.fog===!0&&we.fog!==fe||we.numClippingPlanes!==void 0&&(we.numClippingPlanes!==J.numPlanes||we.numIntersection!==J.numIntersection)||we.vertexAlphas!==Be||we.vertexTangents!==Ze||we.morphTargets!==Se||we.morphNormals!==Qe||we.morphColors!==Ct||we.morphTargetsCount!==Qt||we.numLightProbeGrids!==Kf(w.state.lightProbeGridArray)?rt=!0:(we.outputColorSpace!==ue||we.toneMapping!==yt)&&(Es=!0):(rt=!0,we.__version=z.version);let en=we.currentProgram;(rt===!0||Es===!0)&&(en=Es===!0?jy(z,N,H,ue,yt):io(z,N,H),D&&z.isNodeMaterial&&D.onUpdateProgram(z,en,we));let Sa=!1,is=!1,Rs=!1,tt=en.getUniforms(),Yt=we.uniforms;if(pe.useProgram(en.program)&&(Sa=!0,is=!0,Rs=!0),z.id!==q&&(q=z.id,is=!0),Sa||ee!==A){pe.buffers.depth.getReversed()&&A.reversedDepth!==!0&&(A._reversedDepth=!0,A.updateProjectionMatrix()),tt.setValue(O,"projectionMatrix",A.projectionMatrix),tt.setValue(O,"viewMatrix",A.matrixWorldInverse);let Wt=tt.map.cameraPosition;Wt!==void 0&&Wt.setValue(O,pi.setFromMatrixPosition(A.matrixWorld)),bt.logarithmicDepthBuffer&&tt.setValue(O,"logDepthBufFC",2/(Math.log(A.far+1)/Math.LN2)),(z.isMeshPhongMaterial||z.isMeshToonMaterial||z.isMeshLambertMaterial||z.isMeshBasicMaterial||z.isMeshStandardMaterial||z.isShaderMaterial)&&tt.setValue(O,"isOrthographic",A.isOrthographicCamera===!0),ee!==A&&(ee=A,is=!0,Rs=!0)}if(we.needsLights&&(dn.state.sunShadowMap.length>0&&tt.setValue(O,"sunShadowMap",dn.state.sunShadowMap,Fe),dn.state.directionalShadowMap.length>0&&tt.setValue(O,"directionalShadowMap",dn.state.directionalShadowMap,Fe),dn.state.spotShadowMap.length>0&&tt.setValue(O,"spotShadowMap",dn.state.spotShadowMap,Fe),dn.state.pointShadowMap.length>0&&tt.setValue(O,"pointShadowMap",dn.state.pointShadowMap,Fe)),H.isSkinnedMesh){tt.setOptional(O,H,"bindMatrix"),tt.setOptional(O,H,"bindMatrixInverse");let At=H.skeleton;At&&(At.boneTexture===null&&At.computeBoneTexture(),tt.setValue(O,"boneTexture",At.boneTexture,Fe))}H.isBatchedMesh&&(tt.setOptional(O,H,"batchingTexture"),tt.setValue(O,"batchingTexture",H._matricesTexture,Fe),tt.setOptional(O,H,"batchingIdTexture"),tt.setValue(O,"batchingIdTexture",H._indirectTexture,Fe),tt.setOptional(O,H,"batchingColorTexture"),H._colorsTexture!==null&&tt.setValue(O,"batchingColorTexture",H._colorsTexture,Fe));let ni=X.morphAttributes;if((ni.position!==void 0||ni.normal!==void 0||ni.color!==void 0)&&Z.update(H,X,en),(is||we.receiveShadow!==H.receiveShadow)&&(we.receiveShadow=H.receiveShadow,tt.setValue(O,"receiveShadow",H.receiveShadow)),(z.isMeshStandardMaterial||z.isMeshLambertMaterial||z.isMeshPhongMaterial)&&z.envMap===null&&N.environment!==null&&(Yt.envMapIntensity.value=N.environmentIntensity),Yt.dfgLUT!==void 0&&(Yt.dfgLUT.value=GS()),is){if(tt.setValue(O,"toneMappingExposure",R.toneMappingExposure),we.needsLights&&Zy(Yt,Rs),fe&&z.fog===!0&&ae.refreshFogUniforms(Yt,fe),ae.refreshMaterialUniforms(Yt,z,me,Pe,w.state.transmissionRenderTarget[A.id]),we.needsLights&&we.numLightProbeGrids>0){let At=_,Wt=0;for(let Ei of w.state.lightProbeGridArray)Ei.texture!==null&&(At.textures[Wt]=Ei.texture,At.min[Wt]=Ei.boundingBox.min,At.max[Wt]=Ei.boundingBox.max,At.resolution[Wt]=Ei.resolution,Wt++);for(let Ei in At)At[Ei].length=Wt;Yt.probesSH.value=At.textures,Yt.probesMin.value=At.min,Yt.probesMax.value=At.max,Yt.probesResolution.value=At.resolution}Xr.upload(O,jf(we),Yt,Fe)}if(z.isShaderMaterial&&z.uniformsNeedUpdate===!0&&(Xr.upload(O,jf(we),Yt,Fe),z.uniformsNeedUpdate=!1),z.isSpriteMaterial&&tt.setValue(O,"center",H.center),tt.setValue(O,"modelViewMatrix",H.modelViewMatrix),tt.setValue(O,"normalMatrix",H.normalMatrix),tt.setValue(O,"modelMatrix",H.matrixWorld),z.uniformsGroups!==void 0){let At=z.uniformsGroups;for(let Wt=0,Ei=At.length;Wt<Ei;Wt++){let Qf=At[Wt];Ce.update(Qf,en),Ce.bind(Qf,en)}}return en}function Zy(A,N){A.ambientLightColor.needsUpdate=N,A.lightProbe.needsUpdate=N,A.sunLights.needsUpdate=N,A.sunLightShadows.needsUpdate=N,A.directionalLights.needsUpdate=N,A.directionalLightShadows.needsUpdate=N,A.pointLights.needsUpdate=N,A.pointLightShadows.needsUpdate=N,A.spotLights.needsUpdate=N,A.spotLightShadows.needsUpdate=N,A.rectAreaLights.needsUpdate=N,A.hemisphereLights.needsUpdate=N}function Qy(A){return A.isMeshLambertMaterial||A.isMeshToonMaterial||A.isMeshPhongMaterial||A.isMeshStandardMaterial||A.isShadowMaterial||A.isShaderMaterial&&A.lights===!0}this.getActiveCubeFace=function(){return W},this.getActiveMipmapLevel=function(){return k},this.getRenderTarget=function(){return Q},this.setRenderTargetTextures=function(A,N,X){let z=Ne.get(A);z.__autoAllocateDepthBuffer=A.resolveDepthBuffer===!1,z.__autoAllocateDepthBuffer===!1&&(z.__useRenderToTexture=!1),Ne.get(A.texture).__webglTexture=N,Ne.get(A.depthTexture).__webglTexture=z.__autoAllocateDepthBuffer?void 0:X,z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(A,N){let X=Ne.get(A);X.__webglFramebuffer=N,X.__useDefaultFramebuffer=N===void 0},this.setRenderTarget=function(A,N=0,X=0){Q=A,W=N,k=X;let z=null,H=!1,fe=!1;if(A){let ue=Ne.get(A);if(ue.__useDefaultFramebuffer!==void 0){pe.bindFramebuffer(O.FRAMEBUFFER,ue.__webglFramebuffer),te.copy(A.viewport),_e.copy(A.scissor),Ae=A.scissorTest,pe.viewport(te),pe.scissor(_e),pe.setScissorTest(Ae),q=-1;return}else if(ue.__webglFramebuffer===void 0)Fe.setupRenderTarget(A);else if(ue.__hasExternalTextures)Fe.rebindTextures(A,Ne.get(A.texture).__webglTexture,Ne.get(A.depthTexture).__webglTexture);else if(A.depthBuffer){let Be=A.depthTexture;if(ue.__boundDepthTexture!==Be){if(Be!==null&&Ne.has(Be)&&(A.width!==Be.image.width||A.height!==Be.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Fe.setupDepthRenderbuffer(A)}}let xe=A.texture;(xe.isData3DTexture||xe.isDataArrayTexture||xe.isCompressedArrayTexture)&&(fe=!0);let Te=Ne.get(A).__webglFramebuffer;A.isWebGLCubeRenderTarget?(Array.isArray(Te[N])?z=Te[N][X]:z=Te[N],H=!0):A.samples>0&&Fe.useMultisampledRTT(A)===!1?z=Ne.get(A).__webglMultisampledFramebuffer:Array.isArray(Te)?z=Te[X]:z=Te,te.copy(A.viewport),_e.copy(A.scissor),Ae=A.scissorTest}else te.copy(Le).multiplyScalar(me).floor(),_e.copy(nt).multiplyScalar(me).floor(),Ae=st;if(X!==0&&(z=B),pe.bindFramebuffer(O.FRAMEBUFFER,z)&&pe.drawBuffers(A,z),pe.viewport(te),pe.scissor(_e),pe.setScissorTest(Ae),H){let ue=Ne.get(A.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+N,ue.__webglTexture,X)}else if(fe){let ue=N;for(let xe=0;xe<A.textures.length;xe++){let Te=Ne.get(A.textures[xe]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+xe,Te.__webglTexture,X,ue)}}else if(A!==null&&X!==0){let ue=Ne.get(A.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,ue.__webglTexture,X)}q=-1};function Zf(A){let N=Ne.get(A);return(N.__readFormat!==A.format||N.__readType!==A.type)&&(N.__readFormat=A.format,N.__readType=A.type,N.__formatReadable=bt.textureFormatReadable(A.format),N.__typeReadable=bt.textureTypeReadable(A.type)),N}this.readRenderTargetPixels=function(A,N,X,z,H,fe,Me,ue=0){if(!(A&&A.isWebGLRenderTarget)){De("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xe=Ne.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Me!==void 0&&(xe=xe[Me],Array.isArray(xe)&&(xe=xe[0])),xe){pe.bindFramebuffer(O.FRAMEBUFFER,xe);try{let Te=A.textures[ue],Be=Te.format,Ze=Te.type;A.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+ue);let Se=Zf(Te);if(Se.__formatReadable===!1){De("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Se.__typeReadable===!1){De("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}N>=0&&N<=A.width-z&&X>=0&&X<=A.height-H&&O.readPixels(N,X,z,H,oe.convert(Be),oe.convert(Ze),fe)}finally{let Te=Q!==null?Ne.get(Q).__webglFramebuffer:null;pe.bindFramebuffer(O.FRAMEBUFFER,Te)}}},this.readRenderTargetPixelsAsync=async function(A,N,X,z,H,fe,Me,ue=0){if(!(A&&A.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xe=Ne.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Me!==void 0&&(xe=xe[Me],Array.isArray(xe)&&(xe=xe[0])),xe)if(N>=0&&N<=A.width-z&&X>=0&&X<=A.height-H){pe.bindFramebuffer(O.FRAMEBUFFER,xe);let Te=A.textures[ue],Be=Te.format,Ze=Te.type;A.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+ue);let Se=Zf(Te);if(Se.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Se.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Qe=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,Qe),O.bufferData(O.PIXEL_PACK_BUFFER,fe.byteLength,O.STREAM_READ),O.readPixels(N,X,z,H,oe.convert(Be),oe.convert(Ze),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let Ct=Q!==null?Ne.get(Q).__webglFramebuffer:null;pe.bindFramebuffer(O.FRAMEBUFFER,Ct);let yt=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await Tm(O,yt,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,Qe),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,fe),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(Qe),O.deleteSync(yt),fe}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(A,N=null,X=0){let z=Math.pow(2,-X),H=Math.floor(A.image.width*z),fe=Math.floor(A.image.height*z),Me=N!==null?N.x:0,ue=N!==null?N.y:0;Fe.setTexture2D(A,0),O.copyTexSubImage2D(O.TEXTURE_2D,X,0,0,Me,ue,H,fe),pe.unbindTexture()},this.copyTextureToTexture=function(A,N,X=null,z=null,H=0,fe=0){let Me,ue,xe,Te,Be,Ze,Se,Qe,Ct,yt=A.isCompressedTexture?A.mipmaps[fe]:A.image;if(X!==null)Me=X.max.x-X.min.x,ue=X.max.y-X.min.y,xe=X.isBox3?X.max.z-X.min.z:1,Te=X.min.x,Be=X.min.y,Ze=X.isBox3?X.min.z:0;else{let tt=Math.pow(2,-H);Me=Math.floor(yt.width*tt),ue=Math.floor(yt.height*tt),A.isDataArrayTexture?xe=yt.depth:A.isData3DTexture?xe=Math.floor(yt.depth*tt):xe=1,Te=0,Be=0,Ze=0}z!==null?(Se=z.x,Qe=z.y,Ct=z.z):(Se=0,Qe=0,Ct=0);let pt=oe.convert(N.format),Qt=oe.convert(N.type),we;N.isData3DTexture?(Fe.setTexture3D(N,0),we=O.TEXTURE_3D):N.isDataArrayTexture||N.isCompressedArrayTexture?(Fe.setTexture2DArray(N,0),we=O.TEXTURE_2D_ARRAY):(Fe.setTexture2D(N,0),we=O.TEXTURE_2D),pe.activeTexture(O.TEXTURE0),pe.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,N.flipY),pe.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,N.premultiplyAlpha),pe.pixelStorei(O.UNPACK_ALIGNMENT,N.unpackAlignment);let dn=pe.getParameter(O.UNPACK_ROW_LENGTH),rt=pe.getParameter(O.UNPACK_IMAGE_HEIGHT),Es=pe.getParameter(O.UNPACK_SKIP_PIXELS),en=pe.getParameter(O.UNPACK_SKIP_ROWS),Sa=pe.getParameter(O.UNPACK_SKIP_IMAGES);pe.pixelStorei(O.UNPACK_ROW_LENGTH,yt.width),pe.pixelStorei(O.UNPACK_IMAGE_HEIGHT,yt.height),pe.pixelStorei(O.UNPACK_SKIP_PIXELS,Te),pe.pixelStorei(O.UNPACK_SKIP_ROWS,Be),pe.pixelStorei(O.UNPACK_SKIP_IMAGES,Ze);let is=A.isDataArrayTexture||A.isData3DTexture,Rs=N.isDataArrayTexture||N.isData3DTexture;if(A.isDepthTexture){let tt=Ne.get(A),Yt=Ne.get(N),ni=Ne.get(tt.__renderTarget),At=Ne.get(Yt.__renderTarget);pe.bindFramebuffer(O.READ_FRAMEBUFFER,ni.__webglFramebuffer),pe.bindFramebuffer(O.DRAW_FRAMEBUFFER,At.__webglFramebuffer);for(let Wt=0;Wt<xe;Wt++)is&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Ne.get(A).__webglTexture,H,Ze+Wt),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Ne.get(N).__webglTexture,fe,Ct+Wt)),O.blitFramebuffer(Te,Be,Te+Me,Be+ue,Se,Qe,Se+Me,Qe+ue,O.DEPTH_BUFFER_BIT,O.NEAREST);pe.bindFramebuffer(O.READ_FRAMEBUFFER,null),pe.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if(H!==0||A.isRenderTargetTexture||Ne.has(A)){let tt=Ne.get(A),Yt=Ne.get(N);pe.bindFramebuffer(O.READ_FRAMEBUFFER,P),pe.bindFramebuffer(O.DRAW_FRAMEBUFFER,G);for(let ni=0;ni<xe;ni++)is?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,tt.__webglTexture,H,Ze+ni):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,tt.__webglTexture,H),Rs?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Yt.__webglTexture,fe,Ct+ni):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Yt.__webglTexture,fe),H!==0?O.blitFramebuffer(Te,Be,Te+Me,Be+ue,Se,Qe,Se+Me,Qe+ue,O.COLOR_BUFFER_BIT,O.NEAREST):Rs?O.copyTexSubImage3D(we,fe,Se,Qe,Ct+ni,Te,Be,Me,ue):O.copyTexSubImage2D(we,fe,Se,Qe,Te,Be,Me,ue);pe.bindFramebuffer(O.READ_FRAMEBUFFER,null),pe.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else Rs?A.isDataTexture||A.isData3DTexture?O.texSubImage3D(we,fe,Se,Qe,Ct,Me,ue,xe,pt,Qt,yt.data):N.isCompressedArrayTexture?O.compressedTexSubImage3D(we,fe,Se,Qe,Ct,Me,ue,xe,pt,yt.data):O.texSubImage3D(we,fe,Se,Qe,Ct,Me,ue,xe,pt,Qt,yt):A.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,fe,Se,Qe,Me,ue,pt,Qt,yt.data):A.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,fe,Se,Qe,yt.width,yt.height,pt,yt.data):O.texSubImage2D(O.TEXTURE_2D,fe,Se,Qe,Me,ue,pt,Qt,yt);pe.pixelStorei(O.UNPACK_ROW_LENGTH,dn),pe.pixelStorei(O.UNPACK_IMAGE_HEIGHT,rt),pe.pixelStorei(O.UNPACK_SKIP_PIXELS,Es),pe.pixelStorei(O.UNPACK_SKIP_ROWS,en),pe.pixelStorei(O.UNPACK_SKIP_IMAGES,Sa),fe===0&&N.generateMipmaps===!0&&N.mipmapsAutoUpdate===!0&&O.generateMipmap(we),pe.unbindTexture()},this.initRenderTarget=function(A){Ne.get(A).__webglFramebuffer===void 0&&Fe.setupRenderTarget(A)},this.initTexture=function(A){A.isCubeTexture?Fe.setTextureCube(A,0):A.isData3DTexture?Fe.setTexture3D(A,0):A.isDataArrayTexture||A.isCompressedArrayTexture?Fe.setTexture2DArray(A,0):Fe.setTexture2D(A,0),pe.unbindTexture()},this.resetState=function(){W=0,k=0,Q=null,pe.reset(),le.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return qn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=$e._getDrawingBufferColorSpace(e),t.unpackColorSpace=$e._getUnpackColorSpace()}};function F(i,e={},...t){let{data:n={},aria:s={},on:r={},...o}=e,a=Object.assign(document.createElement(i),o);Object.assign(a.dataset,n);for(let[l,c]of Object.entries(s))a.setAttribute(l==="role"?l:`aria-${l}`,c);for(let[l,c]of Object.entries(r))a.addEventListener(l,c);return a.append(...t.filter(l=>l!=null&&l!==!1)),a}function $(i){return document.getElementById(i)}function Ge(i,e,t={}){return F("button",{type:"button",textContent:i,...t,on:{click:e}})}function ui(i){return F("dl",{className:"pairs"},...i.map(([e,t,n])=>F("div",n?{title:n}:{},F("dt",{textContent:e}),F("dd",{textContent:t}))))}var WS="http://www.w3.org/2000/svg";function jn(i,e,...t){let n=document.createElementNS(WS,i);for(let[s,r]of Object.entries(e))n.setAttribute(s,String(r));return n.append(...t),n}function hc(i){return i.split("`").map((e,t)=>t%2?F("code",{textContent:e}):e)}var pd=null;function md(){return pd??=XS().finally(()=>pd=null),pd}function XS(){let i=$("sign-in"),e=F("input",{type:"password",id:"sign-in-key",autocomplete:"off",required:!0,spellcheck:!1}),t=F("p",{className:"wrong",aria:{role:"alert"}});return new Promise((n,s)=>{let r=F("form",{},F("h2",{id:"sign-in-title",textContent:"Sign in"}),F("p",{},"This service asks for a key, which ",F("code",{textContent:"unwrapd keys create"})," makes."),F("div",{className:"row"},F("label",{htmlFor:e.id,textContent:"API key"}),e),t,F("button",{type:"submit",className:"primary",textContent:"Sign in"}));r.addEventListener("submit",o=>{o.preventDefault(),qS(e.value).then(a=>{if(t.textContent=a??"",e.value="",a!==null)return e.focus();n(),i.close()})}),i.addEventListener("close",()=>s(new Error("Signing in was cancelled. Reload the page to sign in.")),{once:!0}),i.replaceChildren(r),i.showModal(),e.focus()})}async function qS(i){try{let e=await fetch("v1/sign-in",{method:"POST",headers:{authorization:`Bearer ${i.trim()}`}});return e.ok?null:e.status===401?"The service does not know this key, or it has ended.":`The service answered with status ${e.status}.`}catch{return"The service does not answer, or this is no key."}}function hg(i,e){let t=i.owner??"";$("caller").replaceChildren(...i.signed_in?[Ge("Sign out",e,{className:"bare",title:`Signed in as ${t}`})]:[])}function ug(){return $("caller").childElementCount>0}function gd(i,e){if(e===Wu)return console.warn("THREE.BufferGeometryUtils.toTrianglesDrawMode(): Geometry already defined as triangles."),i;if(e===Hr||e===Jo){let t=i.getIndex();if(t===null){let r=[],o=i.getAttribute("position");if(o!==void 0){for(let a=0;a<o.count;a++)r.push(a);i.setIndex(r),t=i.getIndex()}else return console.error("THREE.BufferGeometryUtils.toTrianglesDrawMode(): Undefined position attribute. Processing not possible."),i}let n=t.count-2,s=[];if(e===Hr)for(let r=1;r<=n;r++)s.push(t.getX(0)),s.push(t.getX(r)),s.push(t.getX(r+1));else for(let r=0;r<n;r++)r%2===0?(s.push(t.getX(r)),s.push(t.getX(r+1)),s.push(t.getX(r+2))):(s.push(t.getX(r+2)),s.push(t.getX(r+1)),s.push(t.getX(r)));return s.length/3!==n&&console.error("THREE.BufferGeometryUtils.toTrianglesDrawMode(): Unable to generate correct amount of triangles."),i.setIndex(s),i.clearGroups(),i}else return console.error("THREE.BufferGeometryUtils.toTrianglesDrawMode(): Unknown draw mode:",e),i}function dg(i){let e=new Map,t=new Map,n=i.clone();return fg(i,n,function(s,r){e.set(r,s),t.set(s,r)}),n.traverse(function(s){if(!s.isSkinnedMesh)return;let r=s,o=e.get(s),a=o.skeleton.bones;r.skeleton=o.skeleton.clone(),r.bindMatrix.copy(o.bindMatrix),r.skeleton.bones=a.map(function(l){return t.get(l)}),r.bind(r.skeleton,r.bindMatrix)}),n}function fg(i,e,t){t(i,e);for(let n=0;n<i.children.length;n++)fg(i.children[n],e.children[n],t)}var uc=class extends on{constructor(e){super(e),this.dracoLoader=null,this.ktx2Loader=null,this.meshoptDecoder=null,this.pluginCallbacks=[],this.register(function(t){return new Sd(t)}),this.register(function(t){return new wd(t)}),this.register(function(t){return new Ad(t)}),this.register(function(t){return new Dd(t)}),this.register(function(t){return new Ud(t)}),this.register(function(t){return new Od(t)}),this.register(function(t){return new Ed(t)}),this.register(function(t){return new Rd(t)}),this.register(function(t){return new Cd(t)}),this.register(function(t){return new Pd(t)}),this.register(function(t){return new Md(t)}),this.register(function(t){return new Id(t)}),this.register(function(t){return new Td(t)}),this.register(function(t){return new Nd(t)}),this.register(function(t){return new Ld(t)}),this.register(function(t){return new _d(t)}),this.register(function(t){return new dc(t,Ke.EXT_MESHOPT_COMPRESSION)}),this.register(function(t){return new dc(t,Ke.KHR_MESHOPT_COMPRESSION)}),this.register(function(t){return new Fd(t)})}load(e,t,n,s){let r=this,o;if(this.resourcePath!=="")o=this.resourcePath;else if(this.path!==""){let c=Xi.extractUrlBase(e);o=Xi.resolveURL(c,this.path)}else o=Xi.extractUrlBase(e);this.manager.itemStart(e);let a=function(c){s?s(c):console.error(c),r.manager.itemError(e),r.manager.itemEnd(e)},l=new Yn(this.manager);l.setPriority(this.priority),l.setCache(this.cache),l.setPath(this.path),l.setResponseType("arraybuffer"),l.setRequestHeader(this.requestHeader),l.setWithCredentials(this.withCredentials),l.load(e,function(c){try{r.parse(c,o,function(h){t(h),r.manager.itemEnd(e)},a)}catch(h){a(h)}},n,a)}setDRACOLoader(e){return this.dracoLoader=e,this}setKTX2Loader(e){return this.ktx2Loader=e,this}setMeshoptDecoder(e){return this.meshoptDecoder=e,this}register(e){return this.pluginCallbacks.indexOf(e)===-1&&this.pluginCallbacks.push(e),this}unregister(e){return this.pluginCallbacks.indexOf(e)!==-1&&this.pluginCallbacks.splice(this.pluginCallbacks.indexOf(e),1),this}parse(e,t,n,s){let r,o={},a={},l=new TextDecoder;if(typeof e=="string")r=JSON.parse(e);else if(e instanceof ArrayBuffer)if(l.decode(new Uint8Array(e,0,4))===xg){try{o[Ke.KHR_BINARY_GLTF]=new Bd(e)}catch(u){s&&s(u);return}r=JSON.parse(o[Ke.KHR_BINARY_GLTF].content)}else r=JSON.parse(l.decode(e));else r=e;if(r.asset===void 0||r.asset.version[0]<2){s&&s(new Error("THREE.GLTFLoader: Unsupported asset. glTF versions >=2.0 are supported."));return}let c=new Xd(r,{path:t||this.resourcePath||"",crossOrigin:this.crossOrigin,priority:this.priority,cache:this.cache,withCredentials:this.withCredentials,requestHeader:this.requestHeader,manager:this.manager,ktx2Loader:this.ktx2Loader,meshoptDecoder:this.meshoptDecoder});c.fileLoader.setRequestHeader(this.requestHeader);for(let h=0;h<this.pluginCallbacks.length;h++){let u=this.pluginCallbacks[h](c);u.name||console.error("THREE.GLTFLoader: Invalid plugin found: missing name"),a[u.name]=u,o[u.name]=!0}if(r.extensionsUsed)for(let h=0;h<r.extensionsUsed.length;++h){let u=r.extensionsUsed[h],d=r.extensionsRequired||[];switch(u){case Ke.KHR_MATERIALS_UNLIT:o[u]=new bd;break;case Ke.KHR_DRACO_MESH_COMPRESSION:o[u]=new kd(r,this.dracoLoader);break;case Ke.KHR_TEXTURE_TRANSFORM:o[u]=new zd;break;case Ke.KHR_MESH_QUANTIZATION:o[u]=new Vd;break;default:d.indexOf(u)>=0&&a[u]===void 0&&console.warn('THREE.GLTFLoader: Unknown extension "'+u+'".')}}c.setExtensions(o),c.setPlugins(a),c.parse(n,s)}parseAsync(e,t){let n=this;return new Promise(function(s,r){n.parse(e,t,s,r)})}};function $S(){let i={};return{get:function(e){return i[e]},add:function(e,t){i[e]=t},remove:function(e){delete i[e]},removeAll:function(){i={}}}}function Tt(i,e,t){let n=i.json.materials[e];return n.extensions&&n.extensions[t]?n.extensions[t]:null}var Ke={KHR_BINARY_GLTF:"KHR_binary_glTF",KHR_DRACO_MESH_COMPRESSION:"KHR_draco_mesh_compression",KHR_LIGHTS_PUNCTUAL:"KHR_lights_punctual",KHR_MATERIALS_CLEARCOAT:"KHR_materials_clearcoat",KHR_MATERIALS_DIFFUSE_ROUGHNESS:"KHR_materials_diffuse_roughness",KHR_MATERIALS_DISPERSION:"KHR_materials_dispersion",KHR_MATERIALS_IOR:"KHR_materials_ior",KHR_MATERIALS_SHEEN:"KHR_materials_sheen",KHR_MATERIALS_SPECULAR:"KHR_materials_specular",KHR_MATERIALS_TRANSMISSION:"KHR_materials_transmission",KHR_MATERIALS_IRIDESCENCE:"KHR_materials_iridescence",KHR_MATERIALS_ANISOTROPY:"KHR_materials_anisotropy",KHR_MATERIALS_UNLIT:"KHR_materials_unlit",KHR_MATERIALS_VOLUME:"KHR_materials_volume",KHR_TEXTURE_BASISU:"KHR_texture_basisu",KHR_TEXTURE_TRANSFORM:"KHR_texture_transform",KHR_MESH_QUANTIZATION:"KHR_mesh_quantization",KHR_MATERIALS_EMISSIVE_STRENGTH:"KHR_materials_emissive_strength",EXT_MATERIALS_BUMP:"EXT_materials_bump",EXT_TEXTURE_WEBP:"EXT_texture_webp",EXT_TEXTURE_AVIF:"EXT_texture_avif",EXT_MESHOPT_COMPRESSION:"EXT_meshopt_compression",KHR_MESHOPT_COMPRESSION:"KHR_meshopt_compression",EXT_MESH_GPU_INSTANCING:"EXT_mesh_gpu_instancing"},_d=class{constructor(e){this.parser=e,this.name=Ke.KHR_LIGHTS_PUNCTUAL,this.cache={refs:{},uses:{}}}_markDefs(){let e=this.parser,t=this.parser.json.nodes||[];for(let n=0,s=t.length;n<s;n++){let r=t[n];r.extensions&&r.extensions[this.name]&&r.extensions[this.name].light!==void 0&&e._addNodeRef(this.cache,r.extensions[this.name].light)}}_loadLight(e){let t=this.parser,n="light:"+e,s=t.cache.get(n);if(s)return s;let r=t.json,l=((r.extensions&&r.extensions[this.name]||{}).lights||[])[e],c,h=new be(16777215);l.color!==void 0&&h.setRGB(l.color[0],l.color[1],l.color[2],pn);let u=l.range!==void 0?l.range:0;switch(l.type){case"directional":c=new Wi(h),c.target.position.set(0,0,-1),c.add(c.target);break;case"point":c=new Ws(h),c.distance=u;break;case"spot":c=new Fo(h),c.distance=u,l.spot=l.spot||{},l.spot.innerConeAngle=l.spot.innerConeAngle!==void 0?l.spot.innerConeAngle:0,l.spot.outerConeAngle=l.spot.outerConeAngle!==void 0?l.spot.outerConeAngle:Math.PI/4,c.angle=l.spot.outerConeAngle,c.penumbra=1-l.spot.innerConeAngle/l.spot.outerConeAngle,c.target.position.set(0,0,-1),c.add(c.target);break;default:throw new Error("THREE.GLTFLoader: Unexpected light type: "+l.type)}return c.position.set(0,0,0),wi(c,l),l.intensity!==void 0&&(c.intensity=l.intensity),c.name=t.createUniqueName(l.name||"light_"+e),s=Promise.resolve(c),t.cache.add(n,s),s}getDependency(e,t){if(e==="light")return this._loadLight(t)}createNodeAttachment(e){let t=this,n=this.parser,r=n.json.nodes[e],a=(r.extensions&&r.extensions[this.name]||{}).light;return a===void 0?null:this._loadLight(a).then(function(l){return n._getNodeRef(t.cache,a,l)})}},bd=class{constructor(){this.name=Ke.KHR_MATERIALS_UNLIT}getMaterialType(){return rn}extendParams(e,t,n){let s=[];e.color=new be(1,1,1),e.opacity=1;let r=t.pbrMetallicRoughness;if(r){if(Array.isArray(r.baseColorFactor)){let o=r.baseColorFactor;e.color.setRGB(o[0],o[1],o[2],pn),e.opacity=o[3]}r.baseColorTexture!==void 0&&s.push(n.assignTexture(e,"map",r.baseColorTexture,dt))}return Promise.all(s)}},Md=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_EMISSIVE_STRENGTH}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);return n===null||n.emissiveStrength!==void 0&&(t.emissiveIntensity=n.emissiveStrength),Promise.resolve()}},Sd=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_CLEARCOAT}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];if(n.clearcoatFactor!==void 0&&(t.clearcoat=n.clearcoatFactor),n.clearcoatTexture!==void 0&&s.push(this.parser.assignTexture(t,"clearcoatMap",n.clearcoatTexture)),n.clearcoatRoughnessFactor!==void 0&&(t.clearcoatRoughness=n.clearcoatRoughnessFactor),n.clearcoatRoughnessTexture!==void 0&&s.push(this.parser.assignTexture(t,"clearcoatRoughnessMap",n.clearcoatRoughnessTexture)),n.clearcoatNormalTexture!==void 0&&(s.push(this.parser.assignTexture(t,"clearcoatNormalMap",n.clearcoatNormalTexture)),n.clearcoatNormalTexture.scale!==void 0)){let r=n.clearcoatNormalTexture.scale;t.clearcoatNormalScale=new Ee(r,r)}return Promise.all(s)}},wd=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_DIFFUSE_ROUGHNESS}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];return t.diffuseRoughness=n.diffuseRoughnessFactor!==void 0?n.diffuseRoughnessFactor:0,n.diffuseRoughnessTexture!==void 0&&s.push(this.parser.assignTexture(t,"diffuseRoughnessMap",n.diffuseRoughnessTexture)),Promise.all(s)}},Ad=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_DISPERSION}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);return n===null||(t.dispersion=n.dispersion!==void 0?n.dispersion:0),Promise.resolve()}},Td=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_IRIDESCENCE}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];return n.iridescenceFactor!==void 0&&(t.iridescence=n.iridescenceFactor),n.iridescenceTexture!==void 0&&s.push(this.parser.assignTexture(t,"iridescenceMap",n.iridescenceTexture)),n.iridescenceIor!==void 0&&(t.iridescenceIOR=n.iridescenceIor),n.iridescenceThicknessMinimum!==void 0&&(t.iridescenceThicknessMinimum=n.iridescenceThicknessMinimum),n.iridescenceThicknessMaximum!==void 0&&(t.iridescenceThicknessMaximum=n.iridescenceThicknessMaximum),n.iridescenceThicknessTexture!==void 0&&s.push(this.parser.assignTexture(t,"iridescenceThicknessMap",n.iridescenceThicknessTexture)),Promise.all(s)}},Ed=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_SHEEN}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];if(t.sheenColor=new be(0,0,0),t.sheenRoughness=0,t.sheen=1,n.sheenColorFactor!==void 0){let r=n.sheenColorFactor;t.sheenColor.setRGB(r[0],r[1],r[2],pn)}return n.sheenRoughnessFactor!==void 0&&(t.sheenRoughness=n.sheenRoughnessFactor),n.sheenColorTexture!==void 0&&s.push(this.parser.assignTexture(t,"sheenColorMap",n.sheenColorTexture,dt)),n.sheenRoughnessTexture!==void 0&&s.push(this.parser.assignTexture(t,"sheenRoughnessMap",n.sheenRoughnessTexture)),Promise.all(s)}},Rd=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_TRANSMISSION}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];return n.transmissionFactor!==void 0&&(t.transmission=n.transmissionFactor),n.transmissionTexture!==void 0&&s.push(this.parser.assignTexture(t,"transmissionMap",n.transmissionTexture)),Promise.all(s)}},Cd=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_VOLUME}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];t.thickness=n.thicknessFactor!==void 0?n.thicknessFactor:0,n.thicknessTexture!==void 0&&s.push(this.parser.assignTexture(t,"thicknessMap",n.thicknessTexture)),t.attenuationDistance=n.attenuationDistance||1/0;let r=n.attenuationColor||[1,1,1];return t.attenuationColor=new be().setRGB(r[0],r[1],r[2],pn),Promise.all(s)}},Pd=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_IOR}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);return n===null||(t.ior=n.ior!==void 0?n.ior:1.5,t.ior===0&&(t.ior=1e3)),Promise.resolve()}},Id=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_SPECULAR}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];t.specularIntensity=n.specularFactor!==void 0?n.specularFactor:1,n.specularTexture!==void 0&&s.push(this.parser.assignTexture(t,"specularIntensityMap",n.specularTexture));let r=n.specularColorFactor||[1,1,1];return t.specularColor=new be().setRGB(r[0],r[1],r[2],pn),n.specularColorTexture!==void 0&&s.push(this.parser.assignTexture(t,"specularColorMap",n.specularColorTexture,dt)),Promise.all(s)}},Ld=class{constructor(e){this.parser=e,this.name=Ke.EXT_MATERIALS_BUMP}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];return t.bumpScale=n.bumpFactor!==void 0?n.bumpFactor:1,n.bumpTexture!==void 0&&s.push(this.parser.assignTexture(t,"bumpMap",n.bumpTexture)),Promise.all(s)}},Nd=class{constructor(e){this.parser=e,this.name=Ke.KHR_MATERIALS_ANISOTROPY}getMaterialType(e){return Tt(this.parser,e,this.name)!==null?xn:null}extendMaterialParams(e,t){let n=Tt(this.parser,e,this.name);if(n===null)return Promise.resolve();let s=[];return n.anisotropyStrength!==void 0&&(t.anisotropy=n.anisotropyStrength),n.anisotropyRotation!==void 0&&(t.anisotropyRotation=n.anisotropyRotation),n.anisotropyTexture!==void 0&&s.push(this.parser.assignTexture(t,"anisotropyMap",n.anisotropyTexture)),Promise.all(s)}},Dd=class{constructor(e){this.parser=e,this.name=Ke.KHR_TEXTURE_BASISU}loadTexture(e){let t=this.parser,n=t.json,s=n.textures[e];if(!s.extensions||!s.extensions[this.name])return null;let r=s.extensions[this.name],o=t.options.ktx2Loader;if(!o){if(n.extensionsRequired&&n.extensionsRequired.indexOf(this.name)>=0)throw new Error("THREE.GLTFLoader: setKTX2Loader must be called before loading KTX2 textures");return null}return t.loadTextureImage(e,r.source,o)}},Ud=class{constructor(e){this.parser=e,this.name=Ke.EXT_TEXTURE_WEBP}loadTexture(e){let t=this.name,n=this.parser,s=n.json,r=s.textures[e];if(!r.extensions||!r.extensions[t])return null;let o=r.extensions[t],a=s.images[o.source],l=n.textureLoader;if(a.uri){let c=n.options.manager.getHandler(a.uri);c!==null&&(l=c)}return n.loadTextureImage(e,o.source,l)}},Od=class{constructor(e){this.parser=e,this.name=Ke.EXT_TEXTURE_AVIF}loadTexture(e){let t=this.name,n=this.parser,s=n.json,r=s.textures[e];if(!r.extensions||!r.extensions[t])return null;let o=r.extensions[t],a=s.images[o.source],l=n.textureLoader;if(a.uri){let c=n.options.manager.getHandler(a.uri);c!==null&&(l=c)}return n.loadTextureImage(e,o.source,l)}},dc=class{constructor(e,t){this.name=t,this.parser=e}loadBufferView(e){let t=this.parser.json,n=t.bufferViews[e];if(n.extensions&&n.extensions[this.name]){let s=n.extensions[this.name],r=this.parser.getDependency("buffer",s.buffer),o=this.parser.options.meshoptDecoder;if(!o||!o.supported){if(t.extensionsRequired&&t.extensionsRequired.indexOf(this.name)>=0)throw new Error("THREE.GLTFLoader: setMeshoptDecoder must be called before loading compressed files");return null}return r.then(function(a){let l=s.byteOffset||0,c=s.byteLength||0,h=s.count,u=s.byteStride,d=new Uint8Array(a,l,c);return o.decodeGltfBufferAsync?o.decodeGltfBufferAsync(h,u,d,s.mode,s.filter).then(function(f){return f.buffer}):o.ready.then(function(){let f=new ArrayBuffer(h*u);return o.decodeGltfBuffer(new Uint8Array(f),h,u,d,s.mode,s.filter),f})})}else return null}},Fd=class{constructor(e){this.name=Ke.EXT_MESH_GPU_INSTANCING,this.parser=e}createNodeMesh(e){let t=this.parser.json,n=t.nodes[e];if(!n.extensions||!n.extensions[this.name]||n.mesh===void 0)return null;let s=t.meshes[n.mesh];for(let c of s.primitives)if(c.mode!==Jn.TRIANGLES&&c.mode!==Jn.TRIANGLE_STRIP&&c.mode!==Jn.TRIANGLE_FAN&&c.mode!==void 0)return null;let o=n.extensions[this.name].attributes,a=[],l={};for(let c in o)a.push(this.parser.getDependency("accessor",o[c]).then(h=>(l[c]=h,l[c])));return a.length<1?null:(a.push(this.parser.createNodeMesh(e)),Promise.all(a).then(c=>{let h=c.pop(),u=h.isGroup?h.children:[h],d=c[0].count,f=[];for(let y of u){let x=new ke,m=new U,g=new sn,S=new U(1,1,1),M=new zs(y.geometry,y.material,d);for(let T=0;T<d;T++)l.TRANSLATION&&m.fromBufferAttribute(l.TRANSLATION,T),l.ROTATION&&g.fromBufferAttribute(l.ROTATION,T),l.SCALE&&S.fromBufferAttribute(l.SCALE,T),M.setMatrixAt(T,x.compose(m,g,S));let _=null;for(let T in l)if(T==="_COLOR_0"){let w=l[T];M.instanceColor=new wn(w.array,w.itemSize,w.normalized)}else if(T!=="TRANSLATION"&&T!=="ROTATION"&&T!=="SCALE"){if(_===null){let p=M.geometry;_=new Je,_.name=p.name;for(let v in p.attributes)_.setAttribute(v,p.attributes[v]);for(let v in p.morphAttributes)_.morphAttributes[v]=p.morphAttributes[v];p.index!==null&&_.setIndex(p.index),_.morphTargetsRelative=p.morphTargetsRelative;for(let v of p.groups)_.addGroup(v.start,v.count,v.materialIndex);p.boundingBox!==null&&(_.boundingBox=p.boundingBox.clone()),p.boundingSphere!==null&&(_.boundingSphere=p.boundingSphere.clone()),_.drawRange.start=p.drawRange.start,_.drawRange.count=p.drawRange.count,_.userData=Object.assign({},p.userData),M.geometry=_}let w=l[T];_.setAttribute(T,new wn(w.array,w.itemSize,w.normalized))}xt.prototype.copy.call(M,y),this.parser.assignFinalMaterial(M),f.push(M)}return h.isGroup?(h.clear(),h.add(...f),h):f[0]}))}},xg="glTF",na=12,pg={JSON:1313821514,BIN:5130562},Bd=class{constructor(e){this.name=Ke.KHR_BINARY_GLTF,this.content=null,this.body=null;let t=new DataView(e,0,na),n=new TextDecoder;if(this.header={magic:n.decode(new Uint8Array(e.slice(0,4))),version:t.getUint32(4,!0),length:t.getUint32(8,!0)},this.header.magic!==xg)throw new Error("THREE.GLTFLoader: Unsupported glTF-Binary header.");if(this.header.version<2)throw new Error("THREE.GLTFLoader: Legacy binary file detected.");let s=this.header.length-na,r=new DataView(e,na),o=0;for(;o<s;){let a=r.getUint32(o,!0);o+=4;let l=r.getUint32(o,!0);if(o+=4,l===pg.JSON){let c=new Uint8Array(e,na+o,a);this.content=n.decode(c)}else if(l===pg.BIN){let c=na+o;this.body=e.slice(c,c+a)}o+=a}if(this.content===null)throw new Error("THREE.GLTFLoader: JSON content not found.")}},kd=class{constructor(e,t){if(!t)throw new Error("THREE.GLTFLoader: No DRACOLoader instance provided.");this.name=Ke.KHR_DRACO_MESH_COMPRESSION,this.json=e,this.dracoLoader=t,this.dracoLoader.preload()}decodePrimitive(e,t){let n=this.json,s=this.dracoLoader,r=e.extensions[this.name].bufferView,o=e.extensions[this.name].attributes,a={},l={},c={};for(let h in o){let u=Gd[h]||h.toLowerCase();a[u]=o[h]}for(let h in e.attributes){let u=Gd[h]||h.toLowerCase();if(o[h]!==void 0){let d=n.accessors[e.attributes[h]],f=Kr[d.componentType];c[u]=f.name,l[u]=d.normalized===!0}}return t.getDependency("bufferView",r).then(function(h){return new Promise(function(u,d){s.decodeDracoFile(h,function(f){for(let y in f.attributes){let x=f.attributes[y],m=l[y];m!==void 0&&(x.normalized=m)}u(f)},a,c,pn,d)})})}},zd=class{constructor(){this.name=Ke.KHR_TEXTURE_TRANSFORM}extendTexture(e,t){if((t.texCoord===void 0||t.texCoord===e.channel)&&t.offset===void 0&&t.rotation===void 0&&t.scale===void 0)return e;if(e=e.clone(),t.texCoord!==void 0&&(e.channel=t.texCoord),t.offset!==void 0&&e.offset.fromArray(t.offset),t.rotation!==void 0&&(e.rotation=t.rotation),t.scale!==void 0&&e.repeat.fromArray(t.scale),t.rotation!==void 0){let n=Math.cos(e.rotation),s=Math.sin(e.rotation);e.matrix.set(e.repeat.x*n,e.repeat.y*s,e.offset.x,-e.repeat.x*s,e.repeat.y*n,e.offset.y,0,0,1),e.matrixAutoUpdate=!1}return e.needsUpdate=!0,e}},Vd=class{constructor(){this.name=Ke.KHR_MESH_QUANTIZATION}},fc=class extends xi{constructor(e,t,n,s){super(e,t,n,s)}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s*3+s;for(let o=0;o!==s;o++)t[o]=n[r+o];return t}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=a*2,c=a*3,h=s-t,u=(n-t)/h,d=u*u,f=d*u,y=e*c,x=y-c,m=-2*f+3*d,g=f-d,S=1-m,M=g-d+u;for(let _=0;_!==a;_++){let T=o[x+_+a],w=o[x+_+l]*h,p=o[y+_+a],v=o[y+_]*h;r[_]=S*T+M*w+m*p+g*v}return r}},YS=new sn,Hd=class extends fc{interpolate_(e,t,n,s){let r=super.interpolate_(e,t,n,s);return YS.fromArray(r).normalize().toArray(r),r}},Jn={FLOAT:5126,FLOAT_MAT3:35675,FLOAT_MAT4:35676,FLOAT_VEC2:35664,FLOAT_VEC3:35665,FLOAT_VEC4:35666,LINEAR:9729,REPEAT:10497,SAMPLER_2D:35678,POINTS:0,LINES:1,LINE_LOOP:2,LINE_STRIP:3,TRIANGLES:4,TRIANGLE_STRIP:5,TRIANGLE_FAN:6,UNSIGNED_BYTE:5121,UNSIGNED_SHORT:5123},Kr={5120:Int8Array,5121:Uint8Array,5122:Int16Array,5123:Uint16Array,5125:Uint32Array,5126:Float32Array},mg={9728:Mt,9729:Ot,9984:Ml,9985:kr,9986:$s,9987:Kn},gg={33071:Xn,33648:Sr,10497:$n},yd={SCALAR:1,VEC2:2,VEC3:3,VEC4:4,MAT2:4,MAT3:9,MAT4:16},Gd={POSITION:"position",NORMAL:"normal",TANGENT:"tangent",TEXCOORD_0:"uv",TEXCOORD_1:"uv1",TEXCOORD_2:"uv2",TEXCOORD_3:"uv3",COLOR_0:"color",WEIGHTS_0:"skinWeight",JOINTS_0:"skinIndex"},vs={scale:"scale",translation:"position",rotation:"quaternion",weights:"morphTargetInfluences"},KS={CUBICSPLINE:void 0,LINEAR:Us,STEP:Ds},xd={OPAQUE:"OPAQUE",MASK:"MASK",BLEND:"BLEND"};function jS(i){return i.DefaultMaterial===void 0&&(i.DefaultMaterial=new Tn({color:16777215,emissive:0,metalness:1,roughness:1,transparent:!1,depthTest:!0,side:vi})),i.DefaultMaterial}function Js(i,e,t){for(let n in t.extensions)i[n]===void 0&&(e.userData.gltfExtensions=e.userData.gltfExtensions||{},e.userData.gltfExtensions[n]=t.extensions[n])}function wi(i,e){e.extras!==void 0&&(typeof e.extras=="object"?Object.assign(i.userData,e.extras):console.warn("THREE.GLTFLoader: Ignoring primitive type .extras, "+e.extras))}function JS(i,e,t){let n=!1,s=!1,r=!1;for(let c=0,h=e.length;c<h;c++){let u=e[c];if(u.POSITION!==void 0&&(n=!0),u.NORMAL!==void 0&&(s=!0),u.COLOR_0!==void 0&&(r=!0),n&&s&&r)break}if(!n&&!s&&!r)return Promise.resolve(i);let o=[],a=[],l=[];for(let c=0,h=e.length;c<h;c++){let u=e[c];if(n){let d=u.POSITION!==void 0?t.getDependency("accessor",u.POSITION):i.attributes.position;o.push(d)}if(s){let d=u.NORMAL!==void 0?t.getDependency("accessor",u.NORMAL):i.attributes.normal;a.push(d)}if(r){let d=u.COLOR_0!==void 0?t.getDependency("accessor",u.COLOR_0):i.attributes.color;l.push(d)}}return Promise.all([Promise.all(o),Promise.all(a),Promise.all(l)]).then(function(c){let h=c[0],u=c[1],d=c[2];return n&&(i.morphAttributes.position=h),s&&(i.morphAttributes.normal=u),r&&(i.morphAttributes.color=d),i.morphTargetsRelative=!0,i})}function ZS(i,e){if(i.updateMorphTargets(),e.weights!==void 0)for(let t=0,n=e.weights.length;t<n;t++)i.morphTargetInfluences[t]=e.weights[t];if(e.extras&&Array.isArray(e.extras.targetNames)){let t=e.extras.targetNames;if(i.morphTargetInfluences.length===t.length){i.morphTargetDictionary={};for(let n=0,s=t.length;n<s;n++)i.morphTargetDictionary[t[n]]=n}else console.warn("THREE.GLTFLoader: Invalid extras.targetNames length. Ignoring names.")}}function QS(i){let e,t=i.extensions&&i.extensions[Ke.KHR_DRACO_MESH_COMPRESSION];if(t?e="draco:"+t.bufferView+":"+t.indices+":"+vd(t.attributes):e=i.indices+":"+vd(i.attributes)+":"+i.mode,i.targets!==void 0)for(let n=0,s=i.targets.length;n<s;n++)e+=":"+vd(i.targets[n]);return e}function vd(i){let e="",t=Object.keys(i).sort();for(let n=0,s=t.length;n<s;n++)e+=t[n]+":"+i[t[n]]+";";return e}function Wd(i){switch(i){case Int8Array:return 1/127;case Uint8Array:return 1/255;case Int16Array:return 1/32767;case Uint16Array:return 1/65535;default:throw new Error("THREE.GLTFLoader: Unsupported normalized accessor component type.")}}function ew(i){return i.search(/\.jpe?g($|\?)/i)>0||i.search(/^data\:image\/jpeg/)===0?"image/jpeg":i.search(/\.webp($|\?)/i)>0||i.search(/^data\:image\/webp/)===0?"image/webp":i.search(/\.ktx2($|\?)/i)>0||i.search(/^data\:image\/ktx2/)===0?"image/ktx2":"image/png"}var tw=new ke,Xd=class{constructor(e={},t={}){this.json=e,this.extensions={},this.plugins={},this.options=t,this.cache=new $S,this.associations=new Map,this.primitiveCache={},this.nodeCache={},this.meshCache={refs:{},uses:{}},this.cameraCache={refs:{},uses:{}},this.lightCache={refs:{},uses:{}},this.sourceCache={},this.textureCache={},this.nodeNamesUsed={};let n=!1,s=-1,r=!1,o=-1;if(typeof navigator<"u"&&typeof navigator.userAgent<"u"){let a=navigator.userAgent;n=/^((?!chrome|android).)*safari/i.test(a)===!0;let l=a.match(/Version\/(\d+)/);s=n&&l?parseInt(l[1],10):-1,r=a.indexOf("Firefox")>-1,o=r?a.match(/Firefox\/([0-9]+)\./)[1]:-1}typeof createImageBitmap>"u"||n&&s<17||r&&o<98?(this.textureLoader=new Hi(this.options.manager),this.textureLoader.setPriority(this.options.priority),this.textureLoader.setCache(this.options.cache)):(this.textureLoader=new ko(this.options.manager),this.textureLoader.setPriority(this.options.priority),this.textureLoader.setCache(this.options.cache)),this.textureLoader.setCrossOrigin(this.options.crossOrigin),this.textureLoader.setWithCredentials(this.options.withCredentials),this.textureLoader.setRequestHeader(this.options.requestHeader),this.fileLoader=new Yn(this.options.manager),this.fileLoader.setPriority(this.options.priority),this.fileLoader.setCache(this.options.cache),this.fileLoader.setResponseType("arraybuffer"),(this.options.withCredentials||this.options.crossOrigin==="use-credentials")&&this.fileLoader.setWithCredentials(!0)}setExtensions(e){this.extensions=e}setPlugins(e){this.plugins=e}parse(e,t){let n=this,s=this.json,r=this.extensions;this.cache.removeAll(),this.nodeCache={},this._invokeAll(function(o){return o._markDefs&&o._markDefs()}),Promise.all(this._invokeAll(function(o){return o.beforeRoot&&o.beforeRoot()})).then(function(){return Promise.all([n.getDependencies("scene"),n.getDependencies("animation"),n.getDependencies("camera")])}).then(function(o){let a={scene:o[0][s.scene||0],scenes:o[0],animations:o[1],cameras:o[2],asset:s.asset,parser:n,userData:{}};return Js(r,a,s),wi(a,s),Promise.all(n._invokeAll(function(l){return l.afterRoot&&l.afterRoot(a)})).then(function(){for(let l of a.scenes)l.updateMatrixWorld();e(a)})}).catch(t)}_markDefs(){let e=this.json.nodes||[],t=this.json.skins||[],n=this.json.meshes||[];for(let s=0,r=t.length;s<r;s++){let o=t[s].joints;for(let a=0,l=o.length;a<l;a++)e[o[a]].isBone=!0}for(let s=0,r=e.length;s<r;s++){let o=e[s];o.mesh!==void 0&&(this._addNodeRef(this.meshCache,o.mesh),o.skin!==void 0&&(n[o.mesh].isSkinnedMesh=!0)),o.camera!==void 0&&this._addNodeRef(this.cameraCache,o.camera)}}_addNodeRef(e,t){t!==void 0&&(e.refs[t]===void 0&&(e.refs[t]=e.uses[t]=0),e.refs[t]++)}_getNodeRef(e,t,n){if(e.refs[t]<=1)return n;let s=n.clone(),r=(o,a)=>{let l=this.associations.get(o);l!=null&&this.associations.set(a,l);for(let[c,h]of o.children.entries())r(h,a.children[c])};return r(n,s),s.name+="_instance_"+e.uses[t]++,s}_invokeOne(e){let t=Object.values(this.plugins);t.push(this);for(let n=0;n<t.length;n++){let s=e(t[n]);if(s)return s}return null}_invokeAll(e){let t=Object.values(this.plugins);t.unshift(this);let n=[];for(let s=0;s<t.length;s++){let r=e(t[s]);r&&n.push(r)}return n}getDependency(e,t){let n=e+":"+t,s=this.cache.get(n);if(!s){switch(e){case"scene":s=this.loadScene(t);break;case"node":s=this._invokeOne(function(r){return r.loadNode&&r.loadNode(t)});break;case"mesh":s=this._invokeOne(function(r){return r.loadMesh&&r.loadMesh(t)});break;case"accessor":s=this.loadAccessor(t);break;case"bufferView":s=this._invokeOne(function(r){return r.loadBufferView&&r.loadBufferView(t)});break;case"buffer":s=this.loadBuffer(t);break;case"material":s=this._invokeOne(function(r){return r.loadMaterial&&r.loadMaterial(t)});break;case"texture":s=this._invokeOne(function(r){return r.loadTexture&&r.loadTexture(t)});break;case"skin":s=this.loadSkin(t);break;case"animation":s=this._invokeOne(function(r){return r.loadAnimation&&r.loadAnimation(t)});break;case"camera":s=this.loadCamera(t);break;default:if(s=this._invokeOne(function(r){return r!=this&&r.getDependency&&r.getDependency(e,t)}),!s)throw new Error("Unknown type: "+e);break}this.cache.add(n,s)}return s}getDependencies(e){let t=this.cache.get(e);if(!t){let n=this,s=this.json[e+(e==="mesh"?"es":"s")]||[];t=Promise.all(s.map(function(r,o){return n.getDependency(e,o)})),this.cache.add(e,t)}return t}loadBuffer(e){let t=this.json.buffers[e],n=this.fileLoader;if(t.type&&t.type!=="arraybuffer")throw new Error("THREE.GLTFLoader: "+t.type+" buffer type is not supported.");if(t.uri===void 0&&e===0)return Promise.resolve(this.extensions[Ke.KHR_BINARY_GLTF].body);let s=this.options;return new Promise(function(r,o){n.load(Xi.resolveURL(t.uri,s.path),r,void 0,function(){o(new Error('THREE.GLTFLoader: Failed to load buffer "'+t.uri+'".'))})})}loadBufferView(e){let t=this.json.bufferViews[e];return this.getDependency("buffer",t.buffer).then(function(n){let s=t.byteLength||0,r=t.byteOffset||0;return n.slice(r,r+s)})}loadAccessor(e){let t=this,n=this.json,s=this.json.accessors[e];if(s.bufferView===void 0&&s.sparse===void 0){let o=yd[s.type],a=Kr[s.componentType],l=s.normalized===!0,c=new a(s.count*o);return Promise.resolve(new ze(c,o,l))}let r=[];return s.bufferView!==void 0?r.push(this.getDependency("bufferView",s.bufferView)):r.push(null),s.sparse!==void 0&&(r.push(this.getDependency("bufferView",s.sparse.indices.bufferView)),r.push(this.getDependency("bufferView",s.sparse.values.bufferView))),Promise.all(r).then(function(o){let a=o[0],l=yd[s.type],c=Kr[s.componentType],h=c.BYTES_PER_ELEMENT,u=h*l,d=s.byteOffset||0,f=s.bufferView!==void 0?n.bufferViews[s.bufferView].byteStride:void 0,y=s.normalized===!0,x,m;if(f&&f!==u){let g=Math.floor(d/f),S="InterleavedBuffer:"+s.bufferView+":"+s.componentType+":"+g+":"+s.count,M=t.cache.get(S);M||(x=new c(a,g*f,s.count*f/h),M=new Pr(x,f/h),t.cache.add(S,M)),m=new Ir(M,l,d%f/h,y)}else a===null?x=new c(s.count*l):x=new c(a,d,s.count*l),m=new ze(x,l,y);if(s.sparse!==void 0){let g=yd.SCALAR,S=Kr[s.sparse.indices.componentType],M=s.sparse.indices.byteOffset||0,_=s.sparse.values.byteOffset||0,T=new S(o[1],M,s.sparse.count*g),w=new c(o[2],_,s.sparse.count*l);a!==null&&(m=new ze(m.array.slice(),m.itemSize,m.normalized)),m.normalized=!1;for(let p=0,v=T.length;p<v;p++){let C=T[p];if(m.setX(C,w[p*l]),l>=2&&m.setY(C,w[p*l+1]),l>=3&&m.setZ(C,w[p*l+2]),l>=4&&m.setW(C,w[p*l+3]),l>=5)throw new Error("THREE.GLTFLoader: Unsupported itemSize in sparse BufferAttribute.")}m.normalized=y}return m})}loadTexture(e){let t=this.json,n=this.options,r=t.textures[e].source,o=t.images[r],a=this.textureLoader;if(o.uri){let l=n.manager.getHandler(o.uri);l!==null&&(a=l)}return this.loadTextureImage(e,r,a)}loadTextureImage(e,t,n){let s=this,r=this.json,o=r.textures[e],a=r.images[t],l=(a.uri||a.bufferView)+":"+o.sampler;if(this.textureCache[l])return this.textureCache[l];let c=this.loadImageSource(t,n).then(function(h){h.flipY=!1,h.name=o.name||a.name||"",h.name===""&&typeof a.uri=="string"&&a.uri.startsWith("data:image/")===!1&&(h.name=a.uri);let d=(r.samplers||{})[o.sampler]||{};return h.magFilter=mg[d.magFilter]||Ot,h.minFilter=mg[d.minFilter]||Kn,h.wrapS=gg[d.wrapS]||$n,h.wrapT=gg[d.wrapT]||$n,h.generateMipmaps=!h.isCompressedTexture&&h.minFilter!==Mt&&h.minFilter!==Ot,s.associations.set(h,{textures:e}),h}).catch(function(){return null});return this.textureCache[l]=c,c}loadImageSource(e,t){let n=this,s=this.json,r=this.options;if(this.sourceCache[e]!==void 0)return this.sourceCache[e].then(d=>d.clone());let o=s.images[e],a=self.URL||self.webkitURL,l=o.uri||"",c=!1,h;if(t.isKTX2Loader===!0&&o.bufferView!==void 0)h=n.getDependency("bufferView",o.bufferView).then(function(d){return new Promise(function(f,y){t.parse(d,f,y)})});else{if(o.bufferView!==void 0)l=n.getDependency("bufferView",o.bufferView).then(function(d){c=!0;let f=new Blob([d],{type:o.mimeType});return l=a.createObjectURL(f),l});else if(o.uri===void 0)throw new Error("THREE.GLTFLoader: Image "+e+" is missing URI and bufferView");h=Promise.resolve(l).then(function(d){return new Promise(function(f,y){let x=f;t.isImageBitmapLoader===!0&&(x=function(m){let g=new Ft(m);g.needsUpdate=!0,f(g)}),t.load(Xi.resolveURL(d,r.path),x,void 0,y)})})}let u=h.then(function(d){return c===!0&&a.revokeObjectURL(l),wi(d,o),d.userData.mimeType=o.mimeType||ew(o.uri),d}).catch(function(d){throw console.error("THREE.GLTFLoader: Couldn't load texture",l),d});return this.sourceCache[e]=u,u}assignTexture(e,t,n,s){let r=this;return this.getDependency("texture",n.index).then(function(o){if(!o)return null;if(n.texCoord!==void 0&&n.texCoord>0&&(o=o.clone(),o.channel=n.texCoord),r.extensions[Ke.KHR_TEXTURE_TRANSFORM]){let a=n.extensions!==void 0?n.extensions[Ke.KHR_TEXTURE_TRANSFORM]:void 0;if(a){let l=r.associations.get(o);o=r.extensions[Ke.KHR_TEXTURE_TRANSFORM].extendTexture(o,a),r.associations.set(o,l)}}return s!==void 0&&(o.colorSpace=s),e[t]=o,o})}assignFinalMaterial(e){let t=e.geometry,n=e.material,s=t.attributes.tangent===void 0,r=t.attributes.color!==void 0,o=t.attributes.normal===void 0;if(e.isPoints){let a="PointsMaterial:"+n.uuid,l=this.cache.get(a);l||(l=new li,Bt.prototype.copy.call(l,n),l.color.copy(n.color),l.map=n.map,l.sizeAttenuation=!1,this.cache.add(a,l)),n=l}else if(e.isLine){let a="LineBasicMaterial:"+n.uuid,l=this.cache.get(a);l||(l=new yn,Bt.prototype.copy.call(l,n),l.color.copy(n.color),l.map=n.map,this.cache.add(a,l)),n=l}if(s||r||o){let a="ClonedMaterial:"+n.uuid+":";s&&(a+="derivative-tangents:"),r&&(a+="vertex-colors:"),o&&(a+="flat-shading:");let l=this.cache.get(a);l||(l=n.clone(),r&&(l.vertexColors=!0),o&&(l.flatShading=!0),s&&(l.normalScale&&(l.normalScale.y*=-1),l.clearcoatNormalScale&&(l.clearcoatNormalScale.y*=-1)),this.cache.add(a,l),this.associations.set(l,this.associations.get(n))),n=l}e.material=n}getMaterialType(){return Tn}loadMaterial(e){let t=this,n=this.json,s=this.extensions,r=n.materials[e],o,a={},l=r.extensions||{},c=[];if(l[Ke.KHR_MATERIALS_UNLIT]){let u=s[Ke.KHR_MATERIALS_UNLIT];o=u.getMaterialType(),c.push(u.extendParams(a,r,t))}else{let u=r.pbrMetallicRoughness||{};if(a.color=new be(1,1,1),a.opacity=1,Array.isArray(u.baseColorFactor)){let d=u.baseColorFactor;a.color.setRGB(d[0],d[1],d[2],pn),a.opacity=d[3]}u.baseColorTexture!==void 0&&c.push(t.assignTexture(a,"map",u.baseColorTexture,dt)),a.metalness=u.metallicFactor!==void 0?u.metallicFactor:1,a.roughness=u.roughnessFactor!==void 0?u.roughnessFactor:1,u.metallicRoughnessTexture!==void 0&&(c.push(t.assignTexture(a,"metalnessMap",u.metallicRoughnessTexture)),c.push(t.assignTexture(a,"roughnessMap",u.metallicRoughnessTexture))),o=this._invokeOne(function(d){return d.getMaterialType&&d.getMaterialType(e)}),c.push(Promise.all(this._invokeAll(function(d){return d.extendMaterialParams&&d.extendMaterialParams(e,a)})))}r.doubleSided===!0&&(a.side=Lt);let h=r.alphaMode||xd.OPAQUE;if(h===xd.BLEND?(a.transparent=!0,a.depthWrite=!1):(a.transparent=!1,h===xd.MASK&&(a.alphaTest=r.alphaCutoff!==void 0?r.alphaCutoff:.5)),r.normalTexture!==void 0&&o!==rn&&(c.push(t.assignTexture(a,"normalMap",r.normalTexture)),a.normalScale=new Ee(1,1),r.normalTexture.scale!==void 0)){let u=r.normalTexture.scale;a.normalScale.set(u,u)}if(r.occlusionTexture!==void 0&&o!==rn&&(c.push(t.assignTexture(a,"aoMap",r.occlusionTexture)),r.occlusionTexture.strength!==void 0&&(a.aoMapIntensity=r.occlusionTexture.strength)),r.emissiveFactor!==void 0&&o!==rn){let u=r.emissiveFactor;a.emissive=new be().setRGB(u[0],u[1],u[2],pn)}return r.emissiveTexture!==void 0&&o!==rn&&c.push(t.assignTexture(a,"emissiveMap",r.emissiveTexture,dt)),Promise.all(c).then(function(){let u=new o(a);return r.name&&(u.name=r.name),wi(u,r),t.associations.set(u,{materials:e}),r.extensions&&Js(s,u,r),u})}createUniqueName(e){let t=mt.sanitizeNodeName(e||"");return t in this.nodeNamesUsed?t+"_"+ ++this.nodeNamesUsed[t]:(this.nodeNamesUsed[t]=0,t)}loadGeometries(e){let t=this,n=this.extensions,s=this.primitiveCache;function r(a){return n[Ke.KHR_DRACO_MESH_COMPRESSION].decodePrimitive(a,t).then(function(l){return yg(l,a,t)})}let o=[];for(let a=0,l=e.length;a<l;a++){let c=e[a],h=QS(c),u=s[h];if(u)o.push(u.promise);else{let d;c.extensions&&c.extensions[Ke.KHR_DRACO_MESH_COMPRESSION]?d=r(c):d=yg(new Je,c,t),c.mode===Jn.TRIANGLE_STRIP?d=d.then(f=>gd(f,Jo)):c.mode===Jn.TRIANGLE_FAN&&(d=d.then(f=>gd(f,Hr))),s[h]={primitive:c,promise:d},o.push(d)}}return Promise.all(o)}loadMesh(e){let t=this,n=this.json,s=this.extensions,r=n.meshes[e],o=r.primitives,a=[];for(let l=0,c=o.length;l<c;l++){let h=o[l].material===void 0?jS(this.cache):this.getDependency("material",o[l].material);a.push(h)}return a.push(t.loadGeometries(o)),Promise.all(a).then(async function(l){let c=l.slice(0,l.length-1),h=l[l.length-1],u=[];for(let f=0,y=h.length;f<y;f++){let x=h[f],m=o[f],g,S=c[f];if(m.mode===Jn.TRIANGLES||m.mode===Jn.TRIANGLE_STRIP||m.mode===Jn.TRIANGLE_FAN||m.mode===void 0){let M=r.isSkinnedMesh===!0,_=x.hasAttribute("skinIndex")&&x.hasAttribute("skinWeight");M&&_===!1&&console.warn("THREE.GLTFLoader: Missing skinIndex or skinWeight attributes. Skinning disabled."),g=M&&_?new Ao(x,S):new je(x,S),g.isSkinnedMesh===!0&&g.normalizeSkinWeights()}else if(m.mode===Jn.LINES)g=new Bn(x,S);else if(m.mode===Jn.LINE_STRIP)g=new Vs(x,S);else if(m.mode===Jn.LINE_LOOP)g=new Eo(x,S);else if(m.mode===Jn.POINTS)g=new Oi(x,S);else throw new Error("THREE.GLTFLoader: Primitive mode unsupported: "+m.mode);Object.keys(g.geometry.morphAttributes).length>0&&ZS(g,r),g.name=t.createUniqueName(r.name||"mesh_"+e),wi(g,r),m.extensions&&Js(s,g,m),t.assignFinalMaterial(g),u.push(g)}for(let f=0,y=u.length;f<y;f++)t.associations.set(u[f],{meshes:e,primitives:f});if(u.length===1)return r.extensions&&Js(s,u[0],r),u[0];let d=new On;r.extensions&&Js(s,d,r),t.associations.set(d,{meshes:e});for(let f=0,y=u.length;f<y;f++)d.add(u[f]);return d})}loadCamera(e){let t,n=this.json.cameras[e],s=n[n.type];if(!s){console.warn("THREE.GLTFLoader: Missing camera parameters.");return}return n.type==="perspective"?t=new Ut(Wr.radToDeg(s.yfov),s.aspectRatio||1,s.znear||1,s.zfar||2e6):n.type==="orthographic"&&(t=new Gi(-s.xmag,s.xmag,s.ymag,-s.ymag,s.znear,s.zfar)),n.name&&(t.name=this.createUniqueName(n.name)),wi(t,n),Promise.resolve(t)}loadSkin(e){let t=this.json.skins[e],n=[];for(let s=0,r=t.joints.length;s<r;s++)n.push(this._loadNodeShallow(t.joints[s]));return t.inverseBindMatrices!==void 0?n.push(this.getDependency("accessor",t.inverseBindMatrices)):n.push(null),Promise.all(n).then(function(s){let r=s.pop(),o=s,a=[],l=[];for(let c=0,h=o.length;c<h;c++){let u=o[c];if(u){a.push(u);let d=new ke;r!==null&&d.fromArray(r.array,c*16),l.push(d)}else console.warn('THREE.GLTFLoader: Joint "%s" could not be found.',t.joints[c])}return new To(a,l)})}loadAnimation(e){let t=this.json,n=this,s=t.animations[e],r=s.name?s.name:"animation_"+e,o=[],a=[],l=[],c=[],h=[];for(let u=0,d=s.channels.length;u<d;u++){let f=s.channels[u],y=s.samplers[f.sampler],x=f.target,m=x.node,g=s.parameters!==void 0?s.parameters[y.input]:y.input,S=s.parameters!==void 0?s.parameters[y.output]:y.output;x.node!==void 0&&(o.push(this.getDependency("node",m)),a.push(this.getDependency("accessor",g)),l.push(this.getDependency("accessor",S)),c.push(y),h.push(x))}return Promise.all([Promise.all(o),Promise.all(a),Promise.all(l),Promise.all(c),Promise.all(h)]).then(function(u){let d=u[0],f=u[1],y=u[2],x=u[3],m=u[4],g=[];for(let M=0,_=d.length;M<_;M++){let T=d[M],w=f[M],p=y[M],v=x[M],C=m[M];if(T===void 0)continue;T.updateMatrix&&T.updateMatrix();let R=n._createAnimationTracks(T,w,p,v,C);if(R)for(let I=0;I<R.length;I++)g.push(R[I])}let S=new Uo(r,void 0,g);return wi(S,s),S})}createNodeMesh(e){let t=this.json,n=this,s=t.nodes[e];return s.mesh===void 0?null:n.getDependency("mesh",s.mesh).then(function(r){let o=n._getNodeRef(n.meshCache,s.mesh,r);return s.weights!==void 0&&o.traverse(function(a){if(a.isMesh)for(let l=0,c=s.weights.length;l<c;l++)a.morphTargetInfluences[l]=s.weights[l]}),o})}loadNode(e){let t=this.json,n=this,s=t.nodes[e],r=n._loadNodeShallow(e),o=[],a=s.children||[];for(let c=0,h=a.length;c<h;c++)o.push(n.getDependency("node",a[c]));let l=s.skin===void 0?Promise.resolve(null):n.getDependency("skin",s.skin);return Promise.all([r,Promise.all(o),l]).then(function(c){let h=c[0],u=c[1],d=c[2];d!==null&&h.traverse(function(f){f.isSkinnedMesh&&f.bind(d,tw)});for(let f=0,y=u.length;f<y;f++)h.add(u[f]);if(h.userData.pivot!==void 0&&u.length>0){let f=h.userData.pivot,y=u[0];h.pivot=new U().fromArray(f),h.position.x-=f[0],h.position.y-=f[1],h.position.z-=f[2],y.position.set(0,0,0),delete h.userData.pivot}return h})}_loadNodeShallow(e){let t=this.json,n=this.extensions,s=this;if(this.nodeCache[e]!==void 0)return this.nodeCache[e];let r=t.nodes[e],o=r.name?s.createUniqueName(r.name):"",a=[],l=s._invokeOne(function(c){return c.createNodeMesh&&c.createNodeMesh(e)});return l&&a.push(l),r.camera!==void 0&&a.push(s.getDependency("camera",r.camera).then(function(c){return s._getNodeRef(s.cameraCache,r.camera,c)})),s._invokeAll(function(c){return c.createNodeAttachment&&c.createNodeAttachment(e)}).forEach(function(c){a.push(c)}),this.nodeCache[e]=Promise.all(a).then(function(c){let h;if(r.isBone===!0?h=new Lr:c.length>1?h=new On:c.length===1?h=c[0]:h=new xt,h!==c[0])for(let u=0,d=c.length;u<d;u++)h.add(c[u]);if(r.name&&(h.userData.name=r.name,h.name=o),wi(h,r),r.extensions&&Js(n,h,r),r.matrix!==void 0){let u=new ke;u.fromArray(r.matrix),h.applyMatrix4(u)}else r.translation!==void 0&&h.position.fromArray(r.translation),r.rotation!==void 0&&h.quaternion.fromArray(r.rotation),r.scale!==void 0&&h.scale.fromArray(r.scale);if(!s.associations.has(h))s.associations.set(h,{});else if(r.mesh!==void 0&&s.meshCache.refs[r.mesh]>1){let u=s.associations.get(h);s.associations.set(h,{...u})}return s.associations.get(h).nodes=e,h}),this.nodeCache[e]}loadScene(e){let t=this.extensions,n=this.json.scenes[e],s=this,r=new On;n.name&&(r.name=s.createUniqueName(n.name)),wi(r,n),n.extensions&&Js(t,r,n);let o=n.nodes||[],a=[];for(let l=0,c=o.length;l<c;l++)a.push(s.getDependency("node",o[l]));return Promise.all(a).then(function(l){for(let h=0,u=l.length;h<u;h++){let d=l[h];d.parent!==null?r.add(dg(d)):r.add(d)}let c=h=>{let u=new Map;for(let[d,f]of s.associations)(d instanceof Bt||d instanceof Ft)&&u.set(d,f);return h.traverse(d=>{let f=s.associations.get(d);f!=null&&u.set(d,f)}),u};return s.associations=c(r),r})}_createAnimationTracks(e,t,n,s,r){let o=[],a=e.name?e.name:e.uuid,l=[];function c(f){f.morphTargetInfluences&&l.push(f.name?f.name:f.uuid)}vs[r.path]===vs.weights?(c(e),e.isGroup&&e.children.forEach(c)):l.push(a);let h;switch(vs[r.path]){case vs.weights:h=ki;break;case vs.rotation:h=zi;break;case vs.translation:case vs.scale:h=ps;break;default:n.itemSize===1?h=ki:h=ps;break}let u=s.interpolation!==void 0?KS[s.interpolation]:Us,d=this._getArrayFromAccessor(n);for(let f=0,y=l.length;f<y;f++){let x=new h(l[f]+"."+vs[r.path],t.array,d,u);s.interpolation==="CUBICSPLINE"&&this._createCubicSplineTrackInterpolant(x),o.push(x)}return o}_getArrayFromAccessor(e){let t=e.array;if(e.normalized){let n=Wd(t.constructor),s=new Float32Array(t.length);for(let r=0,o=t.length;r<o;r++)s[r]=t[r]*n;t=s}return t}_createCubicSplineTrackInterpolant(e){e.createInterpolant=function(n){let s=this instanceof zi?Hd:fc;return new s(this.times,this.values,this.getValueSize()/3,n)},e.createInterpolant.isInterpolantFactoryMethodGLTFCubicSpline=!0}};function nw(i,e,t){let n=e.attributes,s=new gn;if(n.POSITION!==void 0){let a=t.json.accessors[n.POSITION],l=a.min,c=a.max;if(l!==void 0&&c!==void 0){if(s.set(new U(l[0],l[1],l[2]),new U(c[0],c[1],c[2])),a.normalized){let h=Wd(Kr[a.componentType]);s.min.multiplyScalar(h),s.max.multiplyScalar(h)}}else{console.warn("THREE.GLTFLoader: Missing min/max properties for accessor POSITION.");return}}else return;let r=e.targets;if(r!==void 0){let a=new U,l=new U;for(let c=0,h=r.length;c<h;c++){let u=r[c];if(u.POSITION!==void 0){let d=t.json.accessors[u.POSITION],f=d.min,y=d.max;if(f!==void 0&&y!==void 0){if(l.setX(Math.max(Math.abs(f[0]),Math.abs(y[0]))),l.setY(Math.max(Math.abs(f[1]),Math.abs(y[1]))),l.setZ(Math.max(Math.abs(f[2]),Math.abs(y[2]))),d.normalized){let x=Wd(Kr[d.componentType]);l.multiplyScalar(x)}a.max(l)}else console.warn("THREE.GLTFLoader: Missing min/max properties for accessor POSITION.")}}s.expandByVector(a)}i.boundingBox=s;let o=new It;s.getCenter(o.center),o.radius=s.min.distanceTo(s.max)/2,i.boundingSphere=o}function yg(i,e,t){let n=e.attributes,s=[];function r(o,a){return t.getDependency("accessor",o).then(function(l){i.setAttribute(a,l)})}for(let o in n){let a=Gd[o]||o.toLowerCase();a in i.attributes||s.push(r(n[o],a))}if(e.indices!==void 0&&!i.index){let o=t.getDependency("accessor",e.indices).then(function(a){i.setIndex(a)});s.push(o)}return $e.workingColorSpace!==pn&&"COLOR_0"in n&&console.warn(`THREE.GLTFLoader: Converting vertex colors from "srgb-linear" to "${$e.workingColorSpace}" not supported.`),wi(i,e),nw(i,e,t),Promise.all(s).then(function(){return e.targets!==void 0?JS(i,e.targets,t):i})}var iw=/^[og]\s*(.+)?/,sw=/^mtllib /,rw=/^usemtl /,ow=/^usemap /,pc=/\s+/,vg=new U,qd=new U,_g=new U,bg=new U,Zn=new U,mc=new be;function aw(){let i={objects:[],object:{},vertices:[],normals:[],colors:[],uvs:[],materials:{},materialLibraries:[],startObject:function(e,t){if(this.object&&this.object.fromDeclaration===!1){this.object.name=e,this.object.fromDeclaration=t!==!1;return}let n=this.object&&typeof this.object.currentMaterial=="function"?this.object.currentMaterial():void 0;if(this.object&&typeof this.object._finalize=="function"&&this.object._finalize(!0),this.object={name:e||"",fromDeclaration:t!==!1,geometry:{vertices:[],normals:[],colors:[],uvs:[],hasUVIndices:!1},materials:[],smooth:!0,startMaterial:function(s,r){let o=this._finalize(!1);o&&(o.inherited||o.groupCount<=0)&&this.materials.splice(o.index,1);let a={index:this.materials.length,name:s||"",mtllib:Array.isArray(r)&&r.length>0?r[r.length-1]:"",smooth:o!==void 0?o.smooth:this.smooth,groupStart:o!==void 0?o.groupEnd:0,groupEnd:-1,groupCount:-1,inherited:!1,clone:function(l){let c={index:typeof l=="number"?l:this.index,name:this.name,mtllib:this.mtllib,smooth:this.smooth,groupStart:0,groupEnd:-1,groupCount:-1,inherited:!1};return c.clone=this.clone.bind(c),c}};return this.materials.push(a),a},currentMaterial:function(){if(this.materials.length>0)return this.materials[this.materials.length-1]},_finalize:function(s){let r=this.currentMaterial();if(r&&r.groupEnd===-1&&(r.groupEnd=this.geometry.vertices.length/3,r.groupCount=r.groupEnd-r.groupStart,r.inherited=!1),s&&this.materials.length>1)for(let o=this.materials.length-1;o>=0;o--)this.materials[o].groupCount<=0&&this.materials.splice(o,1);return s&&this.materials.length===0&&this.materials.push({name:"",smooth:this.smooth}),r}},n&&n.name&&typeof n.clone=="function"){let s=n.clone(0);s.inherited=!0,this.object.materials.push(s)}this.objects.push(this.object)},finalize:function(){this.object&&typeof this.object._finalize=="function"&&this.object._finalize(!0)},parseVertexIndex:function(e,t){let n=parseInt(e,10);return(n>=0?n-1:n+t/3)*3},parseNormalIndex:function(e,t){let n=parseInt(e,10);return(n>=0?n-1:n+t/3)*3},parseUVIndex:function(e,t){let n=parseInt(e,10);return(n>=0?n-1:n+t/2)*2},addVertex:function(e,t,n){let s=this.vertices,r=this.object.geometry.vertices;r.push(s[e+0],s[e+1],s[e+2]),r.push(s[t+0],s[t+1],s[t+2]),r.push(s[n+0],s[n+1],s[n+2])},addVertexPoint:function(e){let t=this.vertices;this.object.geometry.vertices.push(t[e+0],t[e+1],t[e+2])},addVertexLine:function(e){let t=this.vertices;this.object.geometry.vertices.push(t[e+0],t[e+1],t[e+2])},addNormal:function(e,t,n){let s=this.normals,r=this.object.geometry.normals;r.push(s[e+0],s[e+1],s[e+2]),r.push(s[t+0],s[t+1],s[t+2]),r.push(s[n+0],s[n+1],s[n+2])},addFaceNormal:function(e,t,n){let s=this.vertices,r=this.object.geometry.normals;vg.fromArray(s,e),qd.fromArray(s,t),_g.fromArray(s,n),Zn.subVectors(_g,qd),bg.subVectors(vg,qd),Zn.cross(bg),Zn.normalize(),r.push(Zn.x,Zn.y,Zn.z),r.push(Zn.x,Zn.y,Zn.z),r.push(Zn.x,Zn.y,Zn.z)},addColor:function(e,t,n){let s=this.colors,r=this.object.geometry.colors;s[e]!==void 0&&r.push(s[e+0],s[e+1],s[e+2]),s[t]!==void 0&&r.push(s[t+0],s[t+1],s[t+2]),s[n]!==void 0&&r.push(s[n+0],s[n+1],s[n+2])},addUV:function(e,t,n){let s=this.uvs,r=this.object.geometry.uvs;r.push(s[e+0],s[e+1]),r.push(s[t+0],s[t+1]),r.push(s[n+0],s[n+1])},addDefaultUV:function(){let e=this.object.geometry.uvs;e.push(0,0),e.push(0,0),e.push(0,0)},addUVLine:function(e){let t=this.uvs;this.object.geometry.uvs.push(t[e+0],t[e+1])},addFace:function(e,t,n,s,r,o,a,l,c){let h=this.vertices.length,u=this.parseVertexIndex(e,h),d=this.parseVertexIndex(t,h),f=this.parseVertexIndex(n,h);if(this.addVertex(u,d,f),this.addColor(u,d,f),a!==void 0&&a!==""){let y=this.normals.length;u=this.parseNormalIndex(a,y),d=this.parseNormalIndex(l,y),f=this.parseNormalIndex(c,y),this.addNormal(u,d,f)}else this.addFaceNormal(u,d,f);if(s!==void 0&&s!==""){let y=this.uvs.length;u=this.parseUVIndex(s,y),d=this.parseUVIndex(r,y),f=this.parseUVIndex(o,y),this.addUV(u,d,f),this.object.geometry.hasUVIndices=!0}else this.addDefaultUV()},addPointGeometry:function(e){this.object.geometry.type="Points";let t=this.vertices.length;for(let n=0,s=e.length;n<s;n++){let r=this.parseVertexIndex(e[n],t);this.addVertexPoint(r),this.addColor(r)}},addLineGeometry:function(e,t){this.object.geometry.type="Line";let n=this.vertices.length,s=this.uvs.length;for(let r=0,o=e.length-1;r<o;r++)this.addVertexLine(this.parseVertexIndex(e[r],n)),this.addVertexLine(this.parseVertexIndex(e[r+1],n));for(let r=0,o=t.length-1;r<o;r++)this.addUVLine(this.parseUVIndex(t[r],s)),this.addUVLine(this.parseUVIndex(t[r+1],s))}};return i.startObject("",!1),i}var gc=class extends on{constructor(e){super(e),this.materials=null}load(e,t,n,s){let r=this,o=new Yn(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(e,function(a){try{t(r.parse(a))}catch(l){s?s(l):console.error(l),r.manager.itemError(e)}},n,s)}setMaterials(e){return this.materials=e,this}parse(e){let t=new aw;e.indexOf(`\r
`)!==-1&&(e=e.replace(/\r\n/g,`
`)),e.indexOf(`\\
`)!==-1&&(e=e.replace(/\\\n/g,""));let n=e.split(`
`),s=[];for(let a=0,l=n.length;a<l;a++){let c=n[a].trimStart();if(c.length===0)continue;let h=c.charAt(0);if(h!=="#")if(h==="v"){let u=c.split(pc);switch(u[0]){case"v":t.vertices.push(parseFloat(u[1]),parseFloat(u[2]),parseFloat(u[3])),u.length>=7?(mc.setRGB(parseFloat(u[4]),parseFloat(u[5]),parseFloat(u[6]),dt),t.colors.push(mc.r,mc.g,mc.b)):t.colors.push(void 0,void 0,void 0);break;case"vn":t.normals.push(parseFloat(u[1]),parseFloat(u[2]),parseFloat(u[3]));break;case"vt":t.uvs.push(parseFloat(u[1]),parseFloat(u[2]));break}}else if(h==="f"){let d=c.slice(1).trim().split(pc),f=[];for(let x=0,m=d.length;x<m;x++){let g=d[x];if(g.length>0){let S=g.split("/");f.push(S)}}let y=f[0];for(let x=1,m=f.length-1;x<m;x++){let g=f[x],S=f[x+1];t.addFace(y[0],g[0],S[0],y[1],g[1],S[1],y[2],g[2],S[2])}}else if(h==="l"){let u=c.substring(1).trim().split(pc),d=[],f=[];if(c.indexOf("/")===-1)d=u;else for(let y=0,x=u.length;y<x;y++){let m=u[y].split("/");m[0]!==""&&d.push(m[0]),m[1]!==""&&f.push(m[1])}t.addLineGeometry(d,f)}else if(h==="p"){let d=c.slice(1).trim().split(pc);t.addPointGeometry(d)}else if((s=iw.exec(c))!==null){let u=(" "+s[0].slice(1).trim()).slice(1);t.startObject(u)}else if(rw.test(c))t.object.startMaterial(c.substring(7).trim(),t.materialLibraries);else if(sw.test(c))t.materialLibraries.push(c.substring(7).trim());else if(ow.test(c))console.warn('THREE.OBJLoader: Rendering identifier "usemap" not supported. Textures must be defined in MTL files.');else if(h==="s"){if(s=c.split(" "),s.length>1){let d=s[1].trim().toLowerCase();t.object.smooth=d!=="0"&&d!=="off"}else t.object.smooth=!0;let u=t.object.currentMaterial();u&&(u.smooth=t.object.smooth)}else{if(c==="\0")continue;console.warn('THREE.OBJLoader: Unexpected line: "'+c+'"')}}t.finalize();let r=new On;if(r.materialLibraries=[].concat(t.materialLibraries),!(t.objects.length===1&&t.objects[0].geometry.vertices.length===0)===!0)for(let a=0,l=t.objects.length;a<l;a++){let c=t.objects[a],h=c.geometry,u=c.materials,d=h.type==="Line",f=h.type==="Points",y=!1;if(h.vertices.length===0)continue;let x=new Je;x.setAttribute("position",new gt(h.vertices,3)),h.normals.length>0&&x.setAttribute("normal",new gt(h.normals,3)),h.colors.length>0&&(y=!0,x.setAttribute("color",new gt(h.colors,3))),h.hasUVIndices===!0&&x.setAttribute("uv",new gt(h.uvs,2));let m=[];for(let S=0,M=u.length;S<M;S++){let _=u[S],T=_.name+"_"+_.smooth+"_"+y,w=t.materials[T];if(this.materials!==null){if(w=this.materials.create(_.name),d&&w&&!(w instanceof yn)){let p=new yn;Bt.prototype.copy.call(p,w),p.color.copy(w.color),w=p}else if(f&&w&&!(w instanceof li)){let p=new li({size:10,sizeAttenuation:!1});Bt.prototype.copy.call(p,w),p.color.copy(w.color),p.map=w.map,w=p}}w===void 0&&(d?w=new yn:f?w=new li({size:1,sizeAttenuation:!1}):w=new Lo,w.name=_.name,w.flatShading=!_.smooth,w.vertexColors=y,t.materials[T]=w),m.push(w)}let g;if(m.length>1){for(let S=0,M=u.length;S<M;S++){let _=u[S];x.addGroup(_.groupStart,_.groupCount,S)}d?g=new Bn(x,m):f?g=new Oi(x,m):g=new je(x,m)}else d?g=new Bn(x,m[0]):f?g=new Oi(x,m[0]):g=new je(x,m[0]);g.name=c.name,r.add(g)}else if(t.vertices.length>0){let a=new li({size:1,sizeAttenuation:!1}),l=new Je;l.setAttribute("position",new gt(t.vertices,3)),t.colors.length>0&&t.colors[0]!==void 0&&(l.setAttribute("color",new gt(t.colors,3)),a.vertexColors=!0);let c=new Oi(l,a);r.add(c)}return r}};var di=new be,yc=class extends on{constructor(e){super(e),this.propertyNameMapping={},this.customPropertyMapping={}}load(e,t,n,s){let r=this,o=new Yn(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setResponseType("arraybuffer"),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(e,function(a){try{t(r.parse(a))}catch(l){s?s(l):console.error(l),r.manager.itemError(e)}},n,s)}setPropertyNameMapping(e){this.propertyNameMapping=e}setCustomPropertyNameMapping(e){this.customPropertyMapping=e}parse(e){function t(M,_=0){let T=/^ply([\s\S]*)end_header(\r\n|\r|\n)/,w="",p=T.exec(M);p!==null&&(w=p[1]);let v={comments:[],elements:[],headerLength:_,objInfo:""},C=w.split(/\r\n|\r|\n/),R;function I(D,B){let P={type:D[0]};return P.type==="list"?(P.name=D[3],P.countType=D[1],P.itemType=D[2]):P.name=D[1],P.name in B&&(P.name=B[P.name]),P}for(let D=0;D<C.length;D++){let B=C[D];if(B=B.trim(),B==="")continue;let P=B.split(/\s+/),G=P.shift();switch(B=P.join(" "),G){case"format":v.format=P[0],v.version=P[1];break;case"comment":v.comments.push(B);break;case"element":R!==void 0&&v.elements.push(R),R={},R.name=P[0],R.count=parseInt(P[1]),R.properties=[];break;case"property":R.properties.push(I(P,S.propertyNameMapping));break;case"obj_info":v.objInfo=B;break;default:console.log("unhandled",G,P)}}return R!==void 0&&v.elements.push(R),v}function n(M,_){switch(_){case"char":case"uchar":case"short":case"ushort":case"int":case"uint":case"int8":case"uint8":case"int16":case"uint16":case"int32":case"uint32":return parseInt(M);case"float":case"double":case"float32":case"float64":return parseFloat(M)}}function s(M,_){let T={};for(let w=0;w<M.length;w++){if(_.empty())return null;if(M[w].type==="list"){let p=[],v=n(_.next(),M[w].countType);for(let C=0;C<v;C++){if(_.empty())return null;p.push(n(_.next(),M[w].itemType))}T[M[w].name]=p}else T[M[w].name]=n(_.next(),M[w].type)}return T}function r(){let M={indices:[],vertices:[],normals:[],uvs:[],faceVertexUvs:[],colors:[],faceVertexColors:[],descriptors:{}};for(let _ of Object.keys(S.customPropertyMapping))M[_]=[];return M}function o(M){switch(M){case"int8":case"char":return Fs;case"uint8":case"uchar":return Mo;case"int16":case"short":return So;case"uint16":case"ushort":return Bs;case"int32":case"int":return wo;case"uint32":case"uint":return ks;case"float32":case"float":return gt;case"float64":case"double":return $d}}function a(M){switch(M){case"uchar":case"uint8":return 1/255;case"ushort":case"uint16":return 1/65535;case"float":case"float32":case"double":case"float64":return 1;default:return 1/255}}function l(M){return M==="float"||M==="float32"||M==="double"||M==="float64"}function c(M){function _(Q){for(let q of Q){let ee=M.find(te=>te.name===q);if(ee)return ee}return null}let T=_(["x","px","posx"]),w=_(["y","py","posy"]),p=_(["z","pz","posz"]),v=_(["nx","normalx"]),C=_(["ny","normaly"]),R=_(["nz","normalz"]),I=_(["s","u","texture_u","tx"]),D=_(["t","v","texture_v","ty"]),B=_(["red","diffuse_red","r","diffuse_r"]),P=_(["green","diffuse_green","g","diffuse_g"]),G=_(["blue","diffuse_blue","b","diffuse_b"]),W=_(["texcoord"]),k={};for(let Q of Object.keys(S.customPropertyMapping)){let ee=S.customPropertyMapping[Q].map(Ae=>M.find(Y=>Y.name===Ae)),te=ee.filter(Ae=>Ae).map(Ae=>Ae.type),_e=te.length>0&&te.every(Ae=>Ae===te[0]);k[Q]={type:_e?te[0]:"float32",usage:ee.every(Ae=>Ae!==void 0)}}return{position:{names:[T?T.name:"x",w?w.name:"y",p?p.name:"z"],type:T?T.type:"float32",usage:!!(T&&w&&p)},normal:{names:[v?v.name:"nx",C?C.name:"ny",R?R.name:"nz"],type:v?v.type:"float32",usage:!!(v&&C&&R)},uv:{names:[I?I.name:"s",D?D.name:"t"],type:I?I.type:"float32",usage:!!(I&&D)},texcoord:{type:W?W.itemType:"float32",usage:!!W},color:{names:[B?B.name:"red",P?P.name:"green",G?G.name:"blue"],type:B?B.type:"uchar",usage:!!(B&&P&&G)},custom:k}}function h(M,_){let T=r(),w=/end_header\s+(\S[\s\S]*\S|\S)\s*$/,p,v;(v=w.exec(M))!==null?p=v[1].split(/\s+/):p=[];let C=new Yd(p);e:for(let R=0;R<_.elements.length;R++){let I=_.elements[R],D=c(I.properties);T.descriptors[I.name]=D;for(let B=0;B<I.count;B++){let P=s(I.properties,C);if(!P)break e;d(T,I.name,P,D)}}return u(T)}function u(M){let _=new Je,T=M.descriptors.vertex;M.indices.length>0&&_.setIndex(M.indices);let w=o(T?T.position.type:"float32");if(_.setAttribute("position",new w(M.vertices,3)),M.normals.length>0){let p=o(T.normal.type);_.setAttribute("normal",new p(M.normals,3))}if(M.uvs.length>0){let p=o(T.uv.type);_.setAttribute("uv",new p(M.uvs,2))}if(M.colors.length>0){let p=T.color.type,v=!l(p),C=o(p);_.setAttribute("color",new C(M.colors,3,v))}for(let p of Object.keys(S.customPropertyMapping))if(M[p].length>0){let v=o(T.custom[p].type);_.setAttribute(p,new v(M[p],S.customPropertyMapping[p].length))}if(M.faceVertexUvs.length>0||M.faceVertexColors.length>0){if(_=_.toNonIndexed(),M.faceVertexUvs.length>0){let p=o(M.descriptors.face.texcoord.type);_.setAttribute("uv",new p(M.faceVertexUvs,2))}if(M.faceVertexColors.length>0){let p=M.descriptors.face.color.type,v=!l(p),C=o(p);_.setAttribute("color",new C(M.faceVertexColors,3,v))}}return _.computeBoundingSphere(),_}function d(M,_,T,w){if(_==="vertex"){let{position:p,normal:v,uv:C,color:R}=w;if(p.usage&&M.vertices.push(T[p.names[0]],T[p.names[1]],T[p.names[2]]),v.usage&&M.normals.push(T[v.names[0]],T[v.names[1]],T[v.names[2]]),C.usage&&M.uvs.push(T[C.names[0]],T[C.names[1]]),R.usage){let I=a(R.type),D=l(R.type);di.setRGB(T[R.names[0]]*I,T[R.names[1]]*I,T[R.names[2]]*I,dt);let B=1/I;M.colors.push(D?di.r:Math.round(di.r*B),D?di.g:Math.round(di.g*B),D?di.b:Math.round(di.b*B))}for(let I of Object.keys(S.customPropertyMapping))for(let D of S.customPropertyMapping[I])M[I].push(T[D])}else if(_==="face"){let p=T.vertex_indices||T.vertex_index,v=T.texcoord;p.length===3?(M.indices.push(p[0],p[1],p[2]),v&&v.length===6&&(M.faceVertexUvs.push(v[0],v[1]),M.faceVertexUvs.push(v[2],v[3]),M.faceVertexUvs.push(v[4],v[5]))):p.length===4&&(M.indices.push(p[0],p[1],p[2]),M.indices.push(p[0],p[2],p[3]),v&&v.length===8&&(M.faceVertexUvs.push(v[0],v[1]),M.faceVertexUvs.push(v[2],v[3]),M.faceVertexUvs.push(v[4],v[5]),M.faceVertexUvs.push(v[0],v[1]),M.faceVertexUvs.push(v[4],v[5]),M.faceVertexUvs.push(v[6],v[7])));let{color:C}=w;if(C.usage){let R=a(C.type);di.setRGB(T[C.names[0]]*R,T[C.names[1]]*R,T[C.names[2]]*R,dt);let I=1/R,D=di.r*I,B=di.g*I,P=di.b*I;M.faceVertexColors.push(D,B,P),M.faceVertexColors.push(D,B,P),M.faceVertexColors.push(D,B,P),p.length===4&&(M.faceVertexColors.push(D,B,P),M.faceVertexColors.push(D,B,P),M.faceVertexColors.push(D,B,P))}}}function f(M,_){let T={},w=0;for(let p=0;p<_.length;p++){let v=_[p],C=v.valueReader;if(v.type==="list"){let R=[],I=v.countReader.read(M+w);w+=v.countReader.size;for(let D=0;D<I;D++)R.push(C.read(M+w)),w+=C.size;T[v.name]=R}else T[v.name]=C.read(M+w),w+=C.size}return[T,w]}function y(M,_,T){function w(p,v,C){switch(v){case"int8":case"char":return{read:R=>p.getInt8(R),size:1};case"uint8":case"uchar":return{read:R=>p.getUint8(R),size:1};case"int16":case"short":return{read:R=>p.getInt16(R,C),size:2};case"uint16":case"ushort":return{read:R=>p.getUint16(R,C),size:2};case"int32":case"int":return{read:R=>p.getInt32(R,C),size:4};case"uint32":case"uint":return{read:R=>p.getUint32(R,C),size:4};case"float32":case"float":return{read:R=>p.getFloat32(R,C),size:4};case"float64":case"double":return{read:R=>p.getFloat64(R,C),size:8}}}for(let p=0,v=M.length;p<v;p++){let C=M[p];C.type==="list"?(C.countReader=w(_,C.countType,T),C.valueReader=w(_,C.itemType,T)):C.valueReader=w(_,C.type,T)}}function x(M,_){let T=r(),w=_.format==="binary_little_endian",p=new DataView(M,_.headerLength),v,C=0;for(let R=0;R<_.elements.length;R++){let I=_.elements[R],D=I.properties,B=c(D);T.descriptors[I.name]=B,y(D,p,w);for(let P=0;P<I.count;P++){v=f(C,D),C+=v[1];let G=v[0];d(T,I.name,G,B)}}return u(T)}function m(M){let _=0,T=!0,w="",p=[],v=new TextDecoder().decode(M.subarray(0,5)),C=/^ply\r\n/.test(v);do{let R=String.fromCharCode(M[_++]);R!==`
`&&R!=="\r"?w+=R:(w==="end_header"&&(T=!1),w!==""&&(p.push(w),w=""))}while(T&&_<M.length);return C===!0&&_++,{headerText:p.join("\r")+"\r",headerLength:_}}let g,S=this;if(e instanceof ArrayBuffer){let M=new Uint8Array(e),{headerText:_,headerLength:T}=m(M),w=t(_,T);if(w.format==="ascii"){let p=new TextDecoder().decode(M);g=h(p,w)}else g=x(e,w)}else g=h(e,t(e));return g}},$d=class extends ze{constructor(e,t,n){super(new Float64Array(e),t,n)}},Yd=class{constructor(e){this.arr=e,this.i=0}empty(){return this.i>=this.arr.length}next(){return this.arr[this.i++]}};var xc=class extends on{constructor(e){super(e)}load(e,t,n,s){let r=this,o=new Yn(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setResponseType("arraybuffer"),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(e,function(a){try{t(r.parse(a))}catch(l){s?s(l):console.error(l),r.manager.itemError(e)}},n,s)}parse(e){function t(c){let h=new DataView(c),u=32/8*3+32/8*3*3+16/8,d=h.getUint32(80,!0);if(80+32/8+d*u===h.byteLength)return!0;let y=[115,111,108,105,100];for(let x=0;x<5;x++)if(n(y,h,x))return!1;return!0}function n(c,h,u){for(let d=0,f=c.length;d<f;d++)if(c[d]!==h.getUint8(u+d))return!1;return!0}function s(c){let h=new DataView(c),u=h.getUint32(80,!0),d,f,y,x=!1,m,g,S,M,_;for(let I=0;I<=70;I++)h.getUint32(I,!1)==1129270351&&h.getUint8(I+4)==82&&h.getUint8(I+5)==61&&(x=!0,m=new Float32Array(u*3*3),g=h.getUint8(I+6)/255,S=h.getUint8(I+7)/255,M=h.getUint8(I+8)/255,_=h.getUint8(I+9)/255);let T=84,w=50,p=new Je,v=new Float32Array(u*3*3),C=new Float32Array(u*3*3),R=new be;for(let I=0;I<u;I++){let D=T+I*w,B=h.getFloat32(D,!0),P=h.getFloat32(D+4,!0),G=h.getFloat32(D+8,!0);if(x){let W=h.getUint16(D+48,!0);(W&32768)===0?(d=(W&31)/31,f=(W>>5&31)/31,y=(W>>10&31)/31):(d=g,f=S,y=M)}for(let W=1;W<=3;W++){let k=D+W*12,Q=I*3*3+(W-1)*3;v[Q]=h.getFloat32(k,!0),v[Q+1]=h.getFloat32(k+4,!0),v[Q+2]=h.getFloat32(k+8,!0),C[Q]=B,C[Q+1]=P,C[Q+2]=G,x&&(R.setRGB(d,f,y,dt),m[Q]=R.r,m[Q+1]=R.g,m[Q+2]=R.b)}}return p.setAttribute("position",new ze(v,3)),p.setAttribute("normal",new ze(C,3)),x&&(p.setAttribute("color",new ze(m,3)),p.hasColors=!0,p.alpha=_),p}function r(c){let h=new Je,u=/solid([\s\S]*?)endsolid/g,d=/facet([\s\S]*?)endfacet/g,f=/solid\s(.+)/,y=0,x=/[\s]+([+-]?(?:\d*)(?:\.\d*)?(?:[eE][+-]?\d+)?)/.source,m=new RegExp("vertex"+x+x+x,"g"),g=new RegExp("normal"+x+x+x,"g"),S=[],M=[],_=[],T=new U,w,p=0,v=0,C=0;for(;(w=u.exec(c))!==null;){v=C;let R=w[0],I=(w=f.exec(R))!==null?w[1]:"";for(_.push(I);(w=d.exec(R))!==null;){let P=0,G=0,W=w[0];for(;(w=g.exec(W))!==null;)T.x=parseFloat(w[1]),T.y=parseFloat(w[2]),T.z=parseFloat(w[3]),G++;for(;(w=m.exec(W))!==null;)S.push(parseFloat(w[1]),parseFloat(w[2]),parseFloat(w[3])),M.push(T.x,T.y,T.z),P++,C++;G!==1&&console.error("THREE.STLLoader: Something isn't right with the normal of face number "+y),P!==3&&console.error("THREE.STLLoader: Something isn't right with the vertices of face number "+y),y++}let D=v,B=C-v;h.userData.groupNames=_,h.addGroup(D,B,p),p++}return h.setAttribute("position",new gt(S,3)),h.setAttribute("normal",new gt(M,3)),h}function o(c){return typeof c!="string"?new TextDecoder().decode(c):c}function a(c){if(typeof c=="string"){let h=new Uint8Array(c.length);for(let u=0;u<c.length;u++)h[u]=c.charCodeAt(u)&255;return h.buffer||h}else return c}let l=a(e);return t(l)?s(l):r(o(e))}};var jr=["glb","gltf","obj","ply","stl","off"];function cn(i){return i.split(".").pop()?.toLowerCase()??""}var Yi=class extends Error{},lw="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8/5+hHgAHggJ/PchI7wAAAABJRU5ErkJggg==";async function ia(i){let e=cn(i.name);if(e==="glb"||e==="gltf")return hw(i);let t=n=>({scene:n,record:null,parser:null});if(e==="obj")return t(cw(new gc().parse(await i.content.text())));if(e==="ply")return t(Kd(new yc().parse(await i.content.arrayBuffer())));if(e==="stl")return t(Kd(new xc().parse(await i.content.arrayBuffer())));if(e==="off")return t(Kd(dw(await i.content.text())));throw e==="zip"?new Yi("What is in the archive is seen when it is unwrapped."):new Yi(`There is no view of .${e} files here. The job works on it all the same.`)}function cw(i){return i.traverse(e=>{let t=e.geometry?.getAttribute("uv");if(!t)return;let{array:n}=t;for(let s=0;s+6<=n.length;s+=6)n.subarray(s,s+6).every(r=>r===0)&&n.fill(Number.NaN,s,s+6)}),i}function Kd(i){return new je(i,new Tn)}async function hw({content:i,resources:e}){let t=new Nr,n=[],s=new Set;t.setURLModifier(r=>{if(r.startsWith("blob:"))return r;if(r.startsWith("data:"))return n[n.push(URL.createObjectURL(Mg(r)))-1];let o=decodeURIComponent(r).replace(/^\.\//,""),a=e.get(o)??e.get(o.split("/").pop()??"");return a?(n.push(URL.createObjectURL(a)),n.at(-1)):(s.add(o),n.push(URL.createObjectURL(/\.(png|jpe?g|webp|ktx2|avif)$/i.test(o)?Mg(lw):new Blob)),n.at(-1))});try{let r=await new uc(t).parseAsync(await i.arrayBuffer(),"");if(!r.scene)throw new Error("it has no scene. Its meshes can be unwrapped all the same.");let o=r.parser.json.asset?.extras;return{scene:r.scene,record:o?.unwrapd??null,parser:r.parser}}catch(r){let o=String(r instanceof Error?r.message:r);if(/draco|meshopt|ktx2/i.test(o)||await uw(i))throw new Yi("The file is compressed in a way that this view does not decode. Unwrap it: the result is shown.");let a=[...s].find(l=>!/\.(png|jpe?g|webp|ktx2|avif)$/i.test(l));throw a?new Yi(`The file needs ${a}, which was not chosen with it. Choose both together.`):new Error(`The view cannot read this glTF${o.startsWith("it has")?`: ${o}`:". Unwrap it to be told what is wrong with it."}`)}finally{n.forEach(r=>URL.revokeObjectURL(r))}}function Mg(i){let[,e="",t,n=""]=/^data:([^,;]*)(?:;(?!base64)[^,;]*)*(;base64)?,(.*)$/s.exec(i)??[],s=t?atob(n):decodeURIComponent(n);return new Blob([Uint8Array.from(s,r=>r.charCodeAt(0))],{type:e})}async function uw(i){let e=await i.slice(0,1048576).text();return/KHR_draco_mesh_compression|EXT_meshopt_compression|KHR_texture_basisu/.test(e)}function dw(i){let e=i.replace(/#.*/g,"").trim().split(/\s+/);if(!/OFF$/.test(e[0]??""))throw new Error("The file does not begin like an OFF file.");let t=e.slice(1).map(Number),[n=0,s=0]=t,r=t.slice(3,3+3*n),o=[],a=3+3*n;for(let c=0;c<s;c++){let h=t[a]??0;for(let u=2;u<h;u++)o.push(t[a+1],t[a+u],t[a+u+1]);a+=1+h}let l=new Je;return l.setAttribute("position",new ze(Float32Array.from(r),3)),l.setIndex(o),l}function Sg(i){i.traverse(e=>{let{geometry:t,material:n}=e;t?.dispose();for(let s of[n??[]].flat()){for(let r of Object.values(s))r&&typeof r=="object"&&"isTexture"in r&&r.dispose();s.dispose()}})}var Ki=class extends Error{constructor(t){super(t.detail?`${t.title}: ${t.detail}`:t.title);this.problem=t}problem};function Et(i){return i.replace(/^\/(?:.*?\/(?=v1\/))?/,"")}async function ut(i,e={}){let t=await vc(i,e);return t.status===204?null:await t.json()}async function _s(i){return(await vc(i)).blob()}var Zs={isUp:!0,changed:i=>{},set(i){i!==this.isUp&&(this.isUp=i,this.changed(i))}};function wg(){return Zs.set(!1),new Error("The service does not answer. Check that it runs, then try again.")}async function vc(i,e={}){let t;try{t=await fetch(Et(i),e)}catch(n){throw e.signal?.aborted?n:wg()}if(Zs.set(!0),t.ok)return t;if(t.status===401)return await md(),vc(i,e);throw Ag(t.status,await t.json().catch(()=>null))}function Ag(i,e){return e?new Ki(e):new Error(`The service answered with status ${i}.`)}var fw={progressed:()=>{},signal:new AbortController().signal};async function Tg(i,e,{progressed:t,signal:n}){let s=new XMLHttpRequest;if(s.open("POST",Et(i)),s.responseType="json",s.upload.onprogress=({loaded:r,total:o})=>t(r,o),await new Promise((r,o)=>{s.onload=()=>r(),s.onerror=()=>o(wg()),s.onabort=()=>o(n.reason),n.addEventListener("abort",()=>s.abort()),n.throwIfAborted(),s.send(e)}),Zs.set(!0),s.status===401)return await md(),Tg(i,e,{progressed:t,signal:n});if(400<=s.status)throw Ag(s.status,s.response);return s.response}async function Eg(i,e,t){let n=await vc(`${i.links.self}/maps?after=${e}`,{signal:t}).catch(s=>{if(s instanceof Ki&&s.problem.code==="computed_elsewhere")return null;throw s});return n?n.status===204?"none":n.arrayBuffer():"elsewhere"}var Rg=i=>`v1/jobs/${encodeURIComponent(i)}`;function _c(i,e,{name:t,content:n,resources:s},r={},o=fw){let a=new FormData;if(a.append("kind",i),a.append("options",JSON.stringify(e)),Object.keys(r).length&&a.append("metadata",JSON.stringify(r)),a.append("mesh",n,t),["gltf","obj"].includes(cn(t)))for(let[l,c]of s)a.append("resource",c,l);return Tg("v1/jobs",a,o)}function bc({id:i},e,t){let n=new URLSearchParams({job:i,kind:e});for(let[s,r]of Object.entries(t))n.set(s,typeof r=="string"?r:JSON.stringify(r));return ut(`v1/jobs?${n}`,{method:"POST"})}function Rt(i){return i!=="queued"&&i!=="running"}function Qn(i,e){return i.links.files.find(({href:t})=>t.endsWith(`/${e}`))}function jd(i,e){let t=!1,n=0,s,r=()=>{let o=new URL(`${Et(i.links.events)}?after=${n}`,document.baseURI);o.protocol=o.protocol.replace("http","ws"),s=new WebSocket(o),s.onmessage=({data:a})=>{let l=JSON.parse(a);n=l.seq,t||=Rt(l.state),e(l)},s.onclose=()=>{t||ut("readyz").catch(()=>{}),t||setTimeout(()=>t||r(),1e3)}};return r(),()=>{t=!0,s.close()}}async function Cg(i){Rt(i.state)||await new Promise(t=>{let n=jd(i,({state:s})=>{Rt(s)&&(n(),t())})});let e=await ut(i.links.self);if(e.state!=="succeeded")throw e.error?new Ki(e.error):new Error(`The job was ${e.state}.`);return e}function et(i){if(i==null||!Number.isFinite(i))return"–";let e=Math.abs(i);return e!==0&&(e<.001||1e7<=e)?i.toExponential(2):Number(i.toPrecision(4)).toLocaleString("en-US",{maximumFractionDigits:6})}function vt(i){return i.toLocaleString("en-US")}function vn(i){return`${(100*i).toFixed(1)} %`}function ji(i){for(let[e,t]of[["MB",1e6],["kB",1e3]])if(t<=i)return`${(i/t).toFixed(i<10*t?1:0)} ${e}`;return`${i} B`}function Ji(i){let e=i/1e3;return e<60?`${e.toFixed(1)} s`:`${Math.floor(e/60)} min ${Math.floor(e%60)} s`}function Jd(i){let e=Math.max(0,(Date.now()-Date.parse(i))/1e3);return e<60?"just now":e<3600?`${Math.floor(e/60)} min ago`:e<86400?`${Math.floor(e/3600)} h ago`:new Date(i).toLocaleDateString()}function qt(i,e,t=`${e}s`){return`${vt(i)} ${i===1?e:t}`}function Ai(i){let e=i.replaceAll("_"," ").replaceAll("-"," ").replace(/\buv\b/g,"UV");return e.charAt(0).toUpperCase()+e.slice(1)}var _n={a:1,b:0,s:0,t:0};function sa({a:i,b:e,s:t,t:n},[s,r]){return[i*s-e*r+t,e*s+i*r+n]}function Pg(i,e){let[t,n]=sa(e,[i.s,i.t]);return{a:e.a*i.a-e.b*i.b,b:e.b*i.a+e.a*i.b,s:t,t:n}}function Zd([i,e]){return{..._n,s:i,t:e}}function Qd([i,e],t,n){let s=t*Math.PI/180,[r,o]=[n*Math.cos(s),n*Math.sin(s)];return{a:r,b:o,s:i-r*i+o*e,t:e-o*i-r*e}}function ra({a:i,b:e}){return Math.hypot(i,e)}function Mc({a:i,b:e}){return Math.atan2(e,i)*180/Math.PI}function Sc({a:i,b:e,s:t,t:n}){return i===1&&e===0&&t===0&&n===0}var hn=(i,e)=>`${i}/${e}`,wc=class{#e;#t=[];#i=[];constructor(e){this.#e={job:e,placed:new Map,followers:new Map}}get now(){return this.#e}get isUnsaved(){return[...this.places.values()].some(e=>!Sc(e))}get places(){return new Map([...this.#e.followers,...this.#e.placed])}#n(e){this.#t.push(this.#e),this.#i=[],this.#e=e}move(e,t){let n=new Map([...this.#e.placed,...ef(this.places,e,t)].filter(([s])=>this.#e.placed.has(s)||e.includes(s)));this.#n({...this.#e,placed:n,followers:Ig(this.#e.followers,e)})}follow(e){this.#e={...this.#e,followers:Ig(e,[...this.#e.placed.keys()])}}lock(e){let[t,n]=[new Map(this.#e.placed),new Map(this.#e.followers)],s=e.every(o=>t.has(o)),r=0<n.size;for(let o of e){let a=t.get(o)??n.get(o)??_n;t.delete(o),n.delete(o),s?r&&n.set(o,a):t.set(o,a)}this.#n({...this.#e,placed:t,followers:n})}baked(e){this.#n({job:e,placed:new Map([...this.#e.placed.keys()].map(t=>[t,_n])),followers:new Map})}undo(){return this.#s(this.#t,this.#i)}redo(){return this.#s(this.#i,this.#t)}get canUndo(){return 0<this.#t.length}get canRedo(){return 0<this.#i.length}#s(e,t){let n=e.pop();return n?(t.push(this.#e),this.#e=n,!0):!1}};function ef(i,e,t){return new Map([...i,...e.map(n=>[n,Pg(i.get(n)??_n,t)])])}function Ig(i,e){return new Map([...i].filter(([t])=>!e.includes(t)))}function Ac({borders:i,chart:e,group:t},n,s){let r=new Map;i.face.forEach((a,l)=>{if(t[a]!==n)return;let c=r.get(e[a])??[];r.set(e[a],c);for(let h=0;h<4;h++)c.push(i.uvs[4*l+h]*(h%2?1:s))});let o=new Map;return e.forEach((a,l)=>{t[l]===n&&!o.has(a)&&o.set(a,l)}),new Map([...r].map(([a,l])=>{let c=Float64Array.from(l);return[a,{chart:a,face:o.get(a),box:Dg(c),edges:c}]}))}function Lg(i,e){let t=new Float64Array(i.edges.length);for(let n=0;n<t.length;n+=2)t.set(sa(e,[i.edges[n],i.edges[n+1]]),n);return{...i,edges:t,box:Dg(t)}}function Tc([i,e,t,n]){return[(i+t)/2,(e+n)/2]}function Ng(i){return i.reduce(([e,t,n,s],[r,o,a,l])=>[Math.min(e,r),Math.min(t,o),Math.max(n,a),Math.max(s,l)],[1/0,1/0,-1/0,-1/0])}function Dg(i){let e=[1/0,1/0,-1/0,-1/0];for(let t=0;t<i.length;t+=2)e[0]=Math.min(e[0],i[t]),e[1]=Math.min(e[1],i[t+1]),e[2]=Math.max(e[2],i[t]),e[3]=Math.max(e[3],i[t+1]);return e}function Rc(i,e,t){let[[n,s],[r,o]]=[Ec(i,e),Ec(i,t)];return-Math.atan2(n*o-s*r,n*r+s*o)*180/Math.PI}function Cc(i,e,t){return Math.hypot(...Ec(i,t))/Math.max(Math.hypot(...Ec(i,e)),1)}function Ec([i,e],[t,n]){return[t-i,n-e]}var Pc=class{constructor(e,t){this.pane=e;this.doer=t;addEventListener("pointermove",n=>{this.#e=[n.clientX,n.clientY],this.#n()},{capture:!0}),e.addEventListener("pointerdown",n=>{this.#i=this.#t!==null,this.#t&&(Ug(n),e.focus(),this.end(n.button===0))},{capture:!0}),e.addEventListener("pointerup",n=>{this.#i&&Ug(n),this.#i=!1},{capture:!0})}pane;doer;#e=[0,0];#t=null;#i=!1;get gesture(){return this.#t?.gesture??null}start(e,t){this.#t={gesture:e,pivot:t,from:this.#e,axis:null,typed:""},this.#n()}constrain(e){this.#t&&(this.#t.axis=this.#t.axis===e?null:e,this.#n())}type(e){this.#t&&(this.#t.typed=e==="Backspace"?this.#t.typed.slice(0,-1):this.#t.typed+e,this.#n())}end(e){let t=e&&this.#t?this.#s(this.#t):null;this.#t&&(this.#t=null,this.doer.ended(t))}#n(){this.#t&&this.doer.moving(this.#s(this.#t))}#s({gesture:e,pivot:t,from:n,axis:s,typed:r}){let o=r===""?Number.NaN:Number(r),a=Number.isFinite(o),l=this.doer.onPage(t);if(e==="rotate")return Qd(t,a?o:Rc(l,n,this.#e),1);if(e==="scale")return Qd(t,0,Math.max(a?o:Cc(l,n,this.#e),.001));let[[c,h],[u,d]]=[n,this.#e].map(f=>this.doer.inPlane(f));return a?Zd(s===1?[0,o]:[o*this.doer.aspect,0]):Zd([s===1?0:u-c,s===0?0:d-h])}};function Ug(i){i.stopImmediatePropagation(),i.preventDefault()}var pw=["moving","settled","unreached"];function Og(i){return new DataView(i).getUint8(0)===1?{mesh:mw(i)}:{frame:gw(i)}}function mw(i){let e=new DataView(i),[t,n]=[e.getUint8(1),e.getUint8(2)],[s,r,o,a,l,c]=[4,8,12,16,20,24].map(d=>e.getUint32(d,!0)),h=32,u=(d,f,y)=>{let x=new d(i,h,f);return h+=f*y,x};return{dim:t,corners:n,rest:u(Float64Array,t*s,8),elements:u(Uint32Array,n*r,4),triangles:u(Uint32Array,3*o,4),skin:u(Uint32Array,4*a,4),weights:u(Float32Array,4*a,4),picture:[l,c]}}function gw(i){let e=new DataView(i),t=e.getUint32(32,!0)*e.getUint8(3);return{stage:pw[e.getUint8(2)]??"moving",step:e.getUint32(4,!0),message:e.getUint32(8,!0),flips:e.getUint32(12,!0),energy:e.getFloat64(16,!0),smallest:e.getFloat64(24,!0),positions:e.getUint8(1)===4?new Float32Array(i,40,t):new Float64Array(i,40,t)}}var Jr=class{#e;#t=0;#i=new Map;#n=new Map;constructor(e,t){this.#e=new WebSocket(e),this.#e.binaryType="arraybuffer",this.#e.onmessage=({data:n})=>{if(typeof n=="string")return this.#s(JSON.parse(n),t);let s=Og(n);"mesh"in s?t.mesh(s.mesh):t.frame(s.frame,this.#a(s.frame.message))},this.#e.onclose=({code:n,reason:s})=>t.closed(n,s)}say(e){let t=++this.#t;this.#i.set(t,performance.now()),this.#n.set(t,e);let n=JSON.stringify({n:t,...e});return this.#e.readyState===WebSocket.CONNECTING?this.#e.addEventListener("open",()=>this.#e.send(n),{once:!0}):this.#e.send(n),t}close(){this.#e.onclose=null,this.#e.close()}get isAnswered(){return this.#i.size===0}#s(e,t){let n=this.#n.get(e.n)??null;this.#n.delete(e.n),t.reply(e,n)}#a(e){let t=this.#i.get(e);for(let n of this.#i.keys())n<=e&&this.#i.delete(n);return t===void 0?null:performance.now()-t}};var yw=100,xw=20,Ic=class{#e;#t=[];#i=!1;#n=!1;#s=new Map(or("cameras"));#a=new Map(or("grips"));constructor(e){let{kind:t="unwrap",options:n={}}=or("form");this.#e={place:e,subject:{kind:"none"},chosen:[],kind:t,options:n,inHand:null}}get state(){return this.#e}get place(){return this.#e.place}get job(){let{subject:e}=this.#e;return e.kind==="job"?e.job:null}show(e){this.#t.push(e)}change(e){this.#e={...this.#e,...e},("kind"in e||"options"in e)&&so("form",{kind:this.#e.kind,options:this.#e.options}),this.#r()}go(e,t=!1){let n={...this.place,...e};Object.entries(e).every(([r,o])=>String(o)===String(this.place[r]))&&!t||(so("looks",Fg(n)),tp(n,t),this.change({place:n}))}#r(){if(this.#n=!0,!this.#i){this.#i=!0;try{for(;this.#n;){this.#n=!1;for(let e of this.#t)e()}}finally{this.#i=!1}}}remember(e,t){this.#s.delete(e),this.#s.set(e,t);for(let n of[...this.#s.keys()].slice(0,-yw))this.#s.delete(n);so("cameras",[...this.#s])}hold(e,t){this.#a.delete(e),t.length&&this.#a.set(e,t);for(let n of[...this.#a.keys()].slice(0,-xw))this.#a.delete(n);so("grips",[...this.#a])}gripsOf(e){return this.#a.get(e)??[]}cameraOf(e){return this.#s.get(e)??{camera:null,plane:null}}};function Fg({shade:i,measure:e,scale:t,seams:n,wire:s,problems:r,cells:o,aim:a,alone:l,split:c}){return{shade:i,measure:e,scale:t,seams:n,wire:s,problems:r,cells:o,aim:a,alone:l,split:c}}function Lc(i){return{...Kt,...Fg(i)}}function oa(i){let e=[...i.resources.values()].reduce((t,{size:n})=>t+n,0);return`${i.name}:${i.content.size+e}`}function fi({filename:i,input_bytes:e}){return`${i}:${e}`}var Qs=(i,e,t,n={})=>({name:i,title:e,kind:t,options:n,isMap:t==="edit_uv"||t==="texture_map"}),tf=Qs("UVs","Anchors pull the UVs; the shapes that they have are kept","edit_uv"),nf=Qs("UVs to a texture","Anchors pull the UVs inside fixed borders; the shapes of the surface are kept","texture_map"),sf=Qs("Surface in a cage","A cage of cubes around the surface is pulled and carries it along","deform",{cage:14}),Bg=Qs("Planar mesh","The triangles of a mesh in the plane are pulled","deform"),vw=Qs("Mesh","The tetrahedra, or the triangles of the plane, are pulled","deform"),kg=Qs("Picture","A grid over the picture is pulled","warp"),zg=Qs("Outline","The outline is filled with triangles, which are pulled","deform"),Vg=".glb,.gltf,.obj,.ply,.stl,.off,.msh,.mesh,.tet,.png,.jpg,.jpeg,.webp,.svg";function Hg(i,e){switch(cn(i)){case"png":return[kg,zg];case"jpg":case"jpeg":case"webp":return[kg];case"svg":return[zg];case"msh":case"mesh":case"tet":return[vw];default:return e?e.isFlat?[Bg,...e.isMapped?[tf,nf]:[]]:e.isMapped?[tf,nf,sf]:[sf]:[sf,Bg,tf,nf]}}function Nc(i,e){return`${"job"in i?i.job:oa(i)} ${e.name}`}async function Dc(i,{kind:e,options:t}){if("job"in i){let s=new URLSearchParams({job:i.job,kind:e});for(let[r,o]of Object.entries(t))s.set(r,String(o));return ut(`v1/sessions?${s}`,{method:"POST"})}let n=new FormData;n.append("options",JSON.stringify(t)),n.append("mesh",i.content,i.name);for(let[s,r]of i.resources)n.append("resource",r,s);return ut(`v1/sessions?kind=${e}`,{method:"POST",body:n})}function Uc(i){let e=new URL(Et(i.links.live),document.baseURI);return e.protocol=e.protocol.replace("http","ws"),e}function Gg(i,e,t,n,s){return i.atlases.flatMap((r,o)=>[...Ac(i,o,e).values()].flatMap(a=>{let l=t.get(hn(o,a.chart));return l?[_w(a,l,e,n,s)]:[]}))}function _w(i,e,t,n,s){let r=Xg(i,n,s);return Sc(e)?r:{...r,...qg(i,e,t)}}function Wg(i,e,{facts:t,primitives:n}){return{...Xg(i,t,n),...qg(i,e,t.texture.width/t.texture.height)}}function Xg({face:i},{origins:e},t){let n=e.find(({begin:r,count:o})=>r<=i&&i<r+o);return{primitive:t.findIndex(r=>r.mesh===n.mesh&&r.primitive===n.primitive),face:i-n.begin}}function qg({box:i},e,t){let n=Tc(i),[s,r]=sa(e,n);return{pivot:[n[0]/t,1-n[1]],move:[(s-n[0])/t,n[1]-r],turn:-Mc(e),scale:ra(e)}}function $g({origins:i},e){let t=[0];for(let{mesh:n,primitive:s}of e){let r=i.find(o=>o.mesh===n&&o.primitive===s);if(!r)return null;t.push(t.at(-1)+r.count)}return t}function Yg({padding:i=2,mips:e=0}){return i<<e}function Kg({record:i,texture:{width:e,height:t}}){return{count:i.pages??1,aspect:e/t,texel:1/t,padding:Yg(i)}}function Oc({record:i,texture:e},t){let[n,...s]=new Set(t.map(({texcoord:l})=>l));if(s.length)return null;let{group_by:r="scene",pages:o=1,resolution:a=e.width}=i;return{resolution:a,padding:Yg(i),pages:o,group_by:r,source_texcoord:n}}var Fc=class{constructor(e,t){this.arranged=e;this.roomy=t;this.#l()}arranged;roomy;#e=null;#t=null;#i=null;#n=null;#s=null;#a=0;#r=!1;#o=!1;async#l(){let{job:e,facts:t,primitives:n}=this.arranged;try{let s=Oc(t,n);if(!s)throw new Error("The primitives of this file have different UV sets: they cannot be packed together.");let r=await Dc({name:t.source.name,job:e},{kind:"repack",options:s});if(this.#o)return void jg(r);this.#e=r}catch(s){return this.#c(s instanceof Error?s:new Error(String(s)))}this.#t=new Jr(Uc(this.#e),{mesh:s=>this.#u(s),frame:s=>this.#d(s),reply:s=>this.#f(s),closed:()=>this.#c(null)})}get isSettled(){return!this.#r&&this.#s!==null&&this.#s===this.#n?.held&&this.#t?.isAnswered===!0}close(){this.#c(null)}#c(e){this.#o||(this.#o=!0,this.#t?.close(),this.#e&&jg(this.#e),this.roomy.ended(e))}begin(e,t,n){t||(this.#s=null),this.#n={first:e,held:n},this.#a=Number.POSITIVE_INFINITY,this.#h()}hold(e){this.#n&&(this.#n.held=e,this.#h())}cancel(){this.#n=this.#s=null,this.#a=Number.POSITIVE_INFINITY}#h(){let{atlas:e,islands:t}=this.arranged,n=this.#n,s=this.#t;if(!s||!this.#i||!n||!s.isAnswered)return;let r=(a,l)=>s.say({add:{name:a,handle:Wg(t.get(a),l,this.arranged)}}),o=0;if(!this.#s){s.say({reset:{}});for(let a of t.keys())o=r(a,n.first.get(hn(e,a))??_n);this.#s=new Map([...t.keys()].map(a=>[hn(e,a),_n]))}for(let a of t.keys()){let l=hn(e,a),c=n.held.get(l);c&&this.#s.get(l)!==c&&(o=r(a,c)),!c&&this.#s.has(l)&&(o=s.say({remove:{name:a}}))}this.#s=n.held,o&&(this.#a=o)}#u({rest:e,elements:t}){let{analysis:n,atlas:s,facts:r,primitives:o}=this.arranged,a=$g(r,o);if(!a||a.at(-1)!==t.length/3)return this.#c(new Error("The view does not show all meshes of the file."));let l=r.texture.width/r.texture.height,c=u=>[e[2*u]*l,1-e[2*u+1]],h=new Map;for(let{mesh:u,primitive:d,begin:f,count:y}of r.origins){let x=a[o.findIndex(m=>m.mesh===u&&m.primitive===d)];for(let m=0;m<3*y;m++){let g=f+Math.floor(m/3);if(n.group[g]!==s)continue;let S=t[3*x+m],M=h.get(n.chart[g])??[S,S,S,S];[0,1].forEach(_=>{c(S)[_]<c(M[_])[_]&&(M[_]=S),c(S)[_]>c(M[2+_])[_]&&(M[2+_]=S)}),h.set(n.chart[g],M)}}this.#i=new Map([...h].map(([u,[d,f,y,x]])=>{let m=[[d,y],[f,x]],[,g]=m.map(S=>[bw(c(S[0]),c(S[1])),S]).sort(([S],[M])=>M-S)[0];return[u,{numbers:g,at:[c(g[0]),c(g[1])]}]})),this.#h()}#d({message:e,positions:t,stage:n}){if(this.#r=n==="moving",this.#i&&this.#a<=e){let{atlas:s,facts:r}=this.arranged,o=r.texture.width/r.texture.height,a=c=>[t[2*c]*o,1-t[2*c+1]],l=[...this.#i].filter(([c])=>!this.#s?.has(hn(s,c)));this.roomy.follow(new Map(l.map(([c,h])=>[hn(s,c),Mw(h.at,[a(h.numbers[0]),a(h.numbers[1])])])))}this.#h()}#f({error:e}){e&&e.code!=="island_off_page"&&this.#c(new Error(e.detail))}};function jg(i){ut(i.links.self,{method:"DELETE",keepalive:!0}).catch(()=>null)}function bw([i,e],[t,n]){return Math.hypot(t-i,n-e)}function Mw([i,e],[t,n]){let[s,r]=[e[0]-i[0],e[1]-i[1]],[o,a]=[n[0]-t[0],n[1]-t[1]],l=s*s+r*r;if(!l)return{..._n,s:t[0]-i[0],t:t[1]-i[1]};let[c,h]=[(o*s+a*r)/l,(a*s-o*r)/l];return{a:c,b:h,s:t[0]-c*i[0]+h*i[1],t:t[1]-h*i[0]-c*i[1]}}var Zg=[[.95,.002,.012],[.8,.055,.065],[.64,.14,.075],[.46,.15,0],[.28,.09,-.06]],Qg=[[.5,.14,.06],[.72,.08,.06],[.95,0,.005],[.7,-.04,-.08],[.45,-.04,-.14]];function e0(i){return`linear-gradient(to right in oklab, ${Sw(i).map(([t,n,s])=>`oklab(${t} ${n} ${s})`).join(", ")})`}function Sw(i){return i==="density"?Qg:Zg}var Jg=i=>i.map(e=>`vec3(${e.map(t=>t.toFixed(3)).join(", ")})`).join(", "),Bc=`
vec3 oklab(vec3 c) {
  float l = c.x + 0.3963377774 * c.y + 0.2158037573 * c.z;
  float m = c.x - 0.1055613458 * c.y - 0.0638541728 * c.z;
  float s = c.x - 0.0894841775 * c.y - 1.2914855480 * c.z;
  vec3 cubes = vec3(l * l * l, m * m * m, s * s * s);
  vec3 linear = clamp(vec3(
    dot(cubes, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
    dot(cubes, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
    dot(cubes, vec3(-0.0041960863, -0.7034186147, 1.7076147010))), 0.0, 1.0);
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}
const vec3 HEAT[5] = vec3[5](${Jg(Zg)});
const vec3 DENSITY[5] = vec3[5](${Jg(Qg)});
vec3 heatColor(float t) {
  float at = clamp(t, 0.0, 1.0) * 4.0;
  int k = min(int(at), 3);
  return oklab(mix(HEAT[k], HEAT[k + 1], at - float(k)));
}
vec3 densityColor(float t) {
  float at = clamp(t, 0.0, 1.0) * 4.0;
  int k = min(int(at), 3);
  return oklab(mix(DENSITY[k], DENSITY[k + 1], at - float(k)));
}
vec3 chartColor(uint id) {
  float turn = fract(0.58 + 0.6180339887 * float(id)) * 6.2831853;
  float lightness = id % 3u == 0u ? 0.84 : id % 3u == 1u ? 0.78 : 0.88;
  return oklab(vec3(lightness, 0.075 * cos(turn), 0.075 * sin(turn)));
}
`;var Pn=2048,t0=`
precision highp float;
precision highp int;
precision highp usampler2D;
uniform highp usampler2D uIds;
uniform highp sampler2D uValues;
uniform int uAtlas;
uniform float uAspect;
ivec2 texelOf(uint face) { return ivec2(int(face) % ${Pn}, int(face) / ${Pn}); }
`,rf=`
uniform vec2 uOnly;
bool isLeftOut(uint chart, uint group) {
  return 0.0 <= uOnly.x && (float(chart) != uOnly.x || float(group) != uOnly.y);
}
uniform int uArranging;
uniform highp sampler2D uPlaced;
vec4 placedTexel(uint chart, int part) {
  int k = 2 * int(chart) + part;
  return texelFetch(uPlaced, ivec2(k % ${Pn}, k / ${Pn}), 0);
}
int placedMarks(uint chart, uint group) {
  return uArranging == 1 && int(group) == uAtlas ? int(placedTexel(chart, 1).x) : 0;
}
// What is selected lies above the rest.
float placedDepth(uint chart, uint group) {
  return (placedMarks(chart, group) & 1) != 0 ? -0.5 : 0.0;
}
vec2 placedAt(vec2 inPlane, uint chart, uint group) {
  if (uArranging == 0 || int(group) != uAtlas) return inPlane;
  vec4 m = placedTexel(chart, 0);
  vec2 p = vec2(inPlane.x * uAspect, inPlane.y);
  return vec2((m.x * p.x - m.y * p.y + m.z) / uAspect, m.y * p.x + m.x * p.y + m.w);
}
`,kc=`${t0}${rf}
in vec2 faceUv;
flat out uint vFace;
out vec2 vUv;
out vec3 vNormal;
out vec3 vCorner;
void main() {
  vFace = uint(gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  uvec4 ids = texelFetch(uIds, texelOf(vFace), 0);
  uint group = ids.z & 0xffffu;
  vUv = placedAt(faceUv, ids.y, group);
  vNormal = normalMatrix * normal;
#ifdef PLANE
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vUv.x * uAspect, vUv.y, 0.0, 1.0);
  gl_Position.z = placedDepth(ids.y, group);
  if (int(group) != uAtlas || isnan(faceUv.x)) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
#else
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
#endif
  if (isLeftOut(ids.y, group)) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
}`,of=`${t0}${rf}${Bc}
uniform int uShade;
uniform int uMeasure;
uniform vec2 uRange;
uniform vec2 uChecker;
uniform sampler2D uImage;
uniform vec4 uHover;
uniform vec4 uSelected;
uniform int uWire;
uniform int uProblems;
uniform float uPixelRatio;
flat in uint vFace;
in vec2 vUv;
in vec3 vNormal;
in vec3 vCorner;
layout(location = 0) out vec4 color;

const vec3 CLAY = vec3(0.86, 0.87, 0.88);
const vec3 PICKED = vec3(1.0, 0.58, 0.13);

vec3 checker() {
  vec2 cell = floor(vUv * uChecker);
  vec2 block = floor(cell / 8.0);
  float odd = mod(cell.x + cell.y, 2.0);
  float blockOdd = mod(block.x + block.y, 2.0);
  vec3 light = mix(vec3(0.93), vec3(0.86, 0.90, 0.95), blockOdd);
  vec3 dark = mix(vec3(0.50, 0.52, 0.55), vec3(0.36, 0.44, 0.56), blockOdd);
  return mix(light, dark, odd);
}

// Like stretchOf of the analysis.
float stretchOf(float value) {
  if (uMeasure != 0) return value - 1.0;
  float q = max(value / 4.0, 1.0);
  return sqrt(q + sqrt(q * q - 1.0)) - 1.0;
}

vec3 heat() {
  float value = texelFetch(uValues, texelOf(vFace), 0)[uMeasure];
  if (isnan(value)) return vec3(0.69);
  if (uMeasure == 3) return densityColor(log(value / uRange.x) / log(uRange.y / uRange.x));
  return heatColor((stretchOf(value) - uRange.x) / (uRange.y - uRange.x));
}

vec3 fill(uint chart) {
  if (uShade == 3) return heat();
  if (isnan(vUv.x)) return CLAY;
  if (uShade == 1) return chartColor(chart);
  if (uShade == 2) return checker();
  if (uShade == 4) return texture(uImage, vUv).rgb;
  return CLAY;
}

/** Returns 0 on the edges of the face, and 1 farther inside than this number of pixels, softened over 0.8. */
float inner(float pixels) {
  vec3 width = fwidth(vCorner);
  vec3 inside = smoothstep(width * pixels, width * (pixels + 0.8), vCorner);
  return min(inside.x, min(inside.y, inside.z));
}

void main() {
  uvec4 ids = texelFetch(uIds, texelOf(vFace), 0);
  uint marks = ids.z >> 16;
  float face = float(ids.x), chart = float(ids.y), group = float(ids.z & 0xffffu);
  bool isHovered = uHover.x == face || (uHover.y == chart && uHover.z == group);
  bool isFace = uSelected.x == face;
  bool isPicked = isFace || (uSelected.y == chart && uSelected.z == group);
  int placed = placedMarks(ids.y, ids.z & 0xffffu);
  isPicked = isPicked || (placed & 1) != 0;
  bool isWrong = uProblems == 1 && uArranging == 0 && (marks & 3u) != 0u;
#ifdef OVERLAY
  if (!isHovered && !isPicked && !isWrong && placed == 0) discard;
#endif
  vec3 base = fill(ids.y);
  float strength = 1.0;
  if (isWrong) base = (marks & 1u) != 0u ? vec3(0.87, 0.15, 0.17) : vec3(1.0, 0.84, 0.04);
  if ((placed & 4) != 0) base = mix(base, vec3(0.87, 0.15, 0.17), 0.7);
  else if (uArranging == 1) base = mix(base, PICKED, isPicked ? 0.35 : isHovered ? 0.2 : 0.0);
  else {
    // What is selected has an outline: that of a chart or a seam is drawn with the borders. What is pointed at is tinted.
    float edge = isFace ? 1.0 - inner(1.5) : 0.0;
    strength = max(edge, isHovered ? 0.3 : 0.0);
#ifdef OVERLAY
    if (!isWrong) base = PICKED;
#else
    base = mix(base, PICKED, strength);
#endif
  }
  if ((placed & 2) != 0) {
    // Hatched: stripes that stay where they are on the screen.
    float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / uPixelRatio, 9.0);
    base *= 1.0 - 0.34 * smoothstep(0.0, 1.0, stripe) * smoothstep(3.2, 2.2, stripe);
  }
  float light = 1.0;
#ifndef PLANE
  vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
  light = 0.52 + 0.42 * max(dot(n, normalize(vec3(0.25, 0.4, 0.9))), 0.0) + 0.12 * max(n.y, 0.0);
  // What is pointed at is seen in the shade, too.
  if (isHovered) light = mix(light, 1.0, 0.7);
#endif
  if (uWire == 1) {
    vec3 width = fwidth(vCorner);
    // Lines fade where faces are too small for them.
    float dark = 0.42 * clamp(1.0 - 2.2 * max(width.x, max(width.y, width.z)), 0.0, 1.0);
    base *= 1.0 - dark * (1.0 - inner(0.4));
  }
#ifdef OVERLAY
  color = vec4(base * light, isWrong ? 0.9 : placed != 0 ? 0.75 : strength);
#else
  color = vec4(base * light, 1.0);
#endif
}`,n0=`
precision highp float;
precision highp int;
flat in uint vFace;
layout(location = 0) out vec4 color;
void main() {
  uint id = vFace + 1u;
  color = vec4(float(id & 255u), float((id >> 8) & 255u), float((id >> 16) & 255u), float(id >> 24)) / 255.0;
}`,af=`
precision highp float;
precision highp int;
uniform int uAtlas;
uniform float uAspect;
${rf}
uniform vec2 uViewport;
uniform float uPixelRatio;
uniform vec4 uHover;
uniform vec4 uSelected;
uniform float uThick;
uniform int uSeams;
in vec3 from;
in vec3 to;
in vec4 planeEnds;
in uvec4 facts;
flat out uint vId;
flat out vec4 vColor;

// Seams lie this share of their distance before the surface, which hides those behind it at any distance.
vec4 placed(vec3 inScene, vec2 inPlane, float before) {
#ifdef PLANE
  return projectionMatrix * modelViewMatrix * vec4(inPlane.x * uAspect, inPlane.y, 0.0, 1.0);
#else
  vec4 seen = modelViewMatrix * vec4(inScene, 1.0);
  return projectionMatrix * vec4(seen.xyz * (1.0 - before), 1.0);
#endif
}

void main() {
  uint ofGroup = facts.y & 0xffffu;
  int mark = placedMarks(facts.x, ofGroup);
  float chart = float(facts.x), group = float(facts.y & 0xffffu), seam = float(facts.z);
  uint marks = facts.y >> 16;
  bool isHovered = uHover.w == seam || (uHover.y == chart && uHover.z == group);
  bool isPicked = uSelected.w == seam || (uSelected.y == chart && uSelected.z == group);
  isPicked = isPicked || (mark & 1) != 0;
  // Both sides of a seam lie at one place: what is pointed at covers the other.
  float before = isHovered || isPicked ? 0.003 : 0.0015;
  vec4 a = placed(from, placedAt(planeEnds.xy, facts.x, ofGroup), before);
  vec4 b = placed(to, placedAt(planeEnds.zw, facts.x, ofGroup), before);
  bool isNear = uArranging == 1 ? (mark & 4) != 0 : (marks & 4u) != 0u;
  float width = isNear ? 3.0 : (marks & 8u) != 0u ? 2.2 : 1.4;
  if (isHovered || isPicked) width += 1.6;
#ifndef PICK
  else if (uSeams == 0) width = 0.0;
#endif
  width = (width + uThick) * uPixelRatio;
  vColor = (isPicked || isHovered) && !(isNear && uArranging == 1) ? vec4(0.95, 0.45, 0.0, 1.0) : isNear ? vec4(0.87, 0.15, 0.17, 1.0) : vec4(0.07, 0.33, 0.75, 1.0);
  vId = facts.w + 1u;
  vec2 along = (b.xy / b.w - a.xy / a.w) * uViewport;
  along = length(along) < 1e-4 ? vec2(1.0, 0.0) : normalize(along);
  vec2 side = vec2(-along.y, along.x) * position.y + along * (position.x * 2.0 - 1.0) * 0.5;
  gl_Position = position.x < 0.5 ? a : b;
  gl_Position.xy += side * width / uViewport * gl_Position.w;
#ifdef PLANE
  gl_Position.z = placedDepth(facts.x, ofGroup) - 0.01;
  if (int(group) != uAtlas) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
#endif
  if (isLeftOut(facts.x, ofGroup)) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
}`,lf=`
precision highp float;
flat in uint vId;
flat in vec4 vColor;
layout(location = 0) out vec4 color;
void main() {
#ifdef PICK
  color = vec4(float(vId & 255u), float((vId >> 8) & 255u), float((vId >> 16) & 255u), float(vId >> 24)) / 255.0;
#else
  color = vColor;
#endif
}`;var i0=1,s0=2,r0=4,zc=class{constructor(e){this.charts=e;let t=Math.max(1,Math.ceil(2*e/Pn));this.#e=new Float32Array(4*Pn*t),this.texture=new Fn(this.#e,Pn,t,an,Jt);for(let n=0;n<e;n++)this.#e[8*n]=1;this.texture.needsUpdate=!0}charts;texture;#e;put(e,{a:t,b:n,s,t:r},o){this.#e.set([t,n,s,r,o],8*e),this.texture.needsUpdate=!0}};function Vc(i,e,t){if(i.length/4===0)return;let s=ww(i,e),{begins:r,members:o}=Aw(i,s);for(let a=0;a+1<r.length;a++)for(let l=r[a];l<r[a+1];l++){let c=4*o[l];for(let h=r[a];h<l;h++){let u=4*o[h];if(i[u+2]<i[c]||i[c+2]<i[u]||i[u+3]<i[c+1]||i[c+3]<i[u+1])continue;let d=s.column(Math.max(i[c],i[u])),f=s.row(Math.max(i[c+1],i[u+1]));d+s.columns*f===a&&t(u/4,c/4)}}}function ww(i,e){let[t,n,s,r]=[1/0,1/0,-1/0,-1/0];for(let c=0;c<i.length;c+=4)t=Math.min(t,i[c]),n=Math.min(n,i[c+1]),s=Math.max(s,i[c+2]),r=Math.max(r,i[c+3]);let o=Math.max(e,(s-t)/2048,(r-n)/2048)||1,a=Math.floor((s-t)/o)+1,l=Math.floor((r-n)/o)+1;return{columns:a,rows:l,column:c=>Math.floor((c-t)/o),row:c=>Math.floor((c-n)/o)}}function Aw(i,e){let t=new Uint32Array(e.columns*e.rows+1),n=o=>{for(let a=0;a<i.length;a+=4){let[l,c]=[e.column(i[a]),e.column(i[a+2])],h=e.row(i[a+3]);for(let u=e.row(i[a+1]);u<=h;u++)for(let d=l;d<=c;d++)o(d+e.columns*u,a/4)}};n(o=>t[o+1]++);for(let o=1;o<t.length;o++)t[o]+=t[o-1];let s=new Uint32Array(t.at(-1)),r=t.slice();return n((o,a)=>{s[r[o]]=a,r[o]++}),{begins:t,members:s}}function Hc(i){return i%3===2?i-2:i+1}var Tw=.001;function cf(i,e,t){let n=new Uint8Array(e.borders.length),s=t.padding-Tw;if(!(0<s))return n;let r=Ew(i,e,t),o=new Float64Array(r.length);for(let l=0;l<r.length;l+=4){let c=s/2;o[l]=Math.min(r[l],r[l+2])-c,o[l+1]=Math.min(r[l+1],r[l+3])-c,o[l+2]=Math.max(r[l],r[l+2])+c,o[l+3]=Math.max(r[l+1],r[l+3])+c}let a=l=>Math.floor(e.borders[l]/3);return Vc(o,Math.max(4*t.padding,8),(l,c)=>{let[h,u]=[a(l),a(c)];i.group[h]!==i.group[u]||e.ofFace[h]===e.ofFace[u]||hf(r,4*l,r,4*c)<s&&(n[l]=n[c]=1)}),n}function Ew(i,e,{width:t,height:n}){let s=new Float64Array(4*e.borders.length);return e.borders.forEach((r,o)=>{[r,Hc(r)].forEach((a,l)=>{s[4*o+2*l]=i.uvs[2*a]*t,s[4*o+2*l+1]=i.uvs[2*a+1]*n})}),s}function hf(i,e,t,n){return Math.min(Gc(i,e,t,n),Gc(i,e+2,t,n),Gc(t,n,i,e),Gc(t,n+2,i,e))}function Gc(i,e,t,n){let[s,r]=[t[n],t[n+1]],[o,a]=[t[n+2]-s,t[n+3]-r],[l,c]=[i[e]-s,i[e+1]-r],h=o*o+a*a,u=0<h?Math.min(Math.max((l*o+c*a)/h,0),1):0;return Math.hypot(l-u*o,c-u*a)}var uf=.001;function h0({box:[i,e,t,n]},{count:s,aspect:r,texel:o}){let a=Math.floor((i+t)/2/r),l=uf*o;return 0<=a&&a<s&&a*r-l<=i&&t<=(a+1)*r+l&&-l<=e&&n<=1+l}var aa=class{constructor(e,{texel:t,padding:n}){this.islands=e;this.#e=Math.max(n-uf,uf)*t,this.#t=Math.max(4*this.#e,1/64);for(let s of e)for(let r=0;r<s.edges.length;r+=4)this.#s(o0(s.edges,r),o=>this.#n(o).push([s,r]))}islands;#e;#t;#i=new Map;#n(e){let t=this.#i.get(e)??[];return this.#i.set(e,t),t}#s([e,t,n,s],r){let o=a=>Math.floor(a/this.#t);for(let a=o(e);a<=o(n);a++)for(let l=o(t);l<=o(s);l++)r(`${a},${l}`)}near(e){let t=new Set,n=a0(e.box,this.#e),s=this.islands.filter(r=>r.chart!==e.chart&&u0(n,r.box));for(let r of s)(c0(e,r)||c0(r,e))&&t.add(r);if(t.size===s.length)return t;for(let r=0;r<e.edges.length;r+=4)this.#s(a0(o0(e.edges,r),this.#e),o=>{for(let[a,l]of this.#i.get(o)??[])a.chart===e.chart||t.has(a)||(hf(e.edges,r,a.edges,l)<this.#e||Rw(e.edges,r,a.edges,l))&&t.add(a)});return t}};function o0(i,e){let[t,n,s,r]=[i[e],i[e+1],i[e+2],i[e+3]];return[Math.min(t,s),Math.min(n,r),Math.max(t,s),Math.max(n,r)]}function a0([i,e,t,n],s){return[i-s,e-s,t+s,n+s]}function u0(i,e){return i[0]<=e[2]&&e[0]<=i[2]&&i[1]<=e[3]&&e[1]<=i[3]}function l0(i,e,t,n){return Math.sign((i[e+2]-i[e])*(n-i[e+1])-(i[e+3]-i[e+1])*(t-i[e]))}function Rw(i,e,t,n){let s=(r,o,a,l)=>l0(r,o,a[l],a[l+1])*l0(r,o,a[l+2],a[l+3])<0;return s(i,e,t,n)&&s(t,n,i,e)}function c0({edges:i,box:e},t){let[n,s]=[t.edges[0],t.edges[1]];if(!u0(e,[n,s,n,s]))return!1;let r=0;for(let o=0;o<i.length;o+=4){let[a,l,c,h]=[i[o],i[o+1],i[o+2],i[o+3]];l<=s!=h<=s&&n<a+(c-a)*(s-l)/(h-l)&&(r+=l<=s?1:-1)}return r!==0}var Wc=class{constructor(e,t,n){this.analysis=e;this.atlas=t;this.pages=n;this.islands=Ac(e,t,n.aspect),this.placed=new zc(e.atlases[t].charts)}analysis;atlas;pages;islands;placed;at(e,t){let n=this.islands.get(e),s=t.get(hn(this.atlas,e));return s?Lg(n,s):n}locked(e){return[...this.islands.keys()].filter(t=>e.has(hn(this.atlas,t)))}moving(e,t,n){let s=[...n].filter(r=>!e.has(r)).map(r=>this.at(r,t));return{charts:new Set(e),neighbors:new aa(s,this.pages)}}faults(e,t){let n=new Set,s=this.locked(e).map(o=>this.at(o,e));for(let o of s)h0(o,this.pages)||n.add(o.chart);let r=t?.neighbors??new aa(s,this.pages);for(let o of s){if(t&&!t.charts.has(o.chart))continue;let a=r.near(o);a.size&&n.add(o.chart);for(let{chart:l}of a)e.has(hn(this.atlas,l))&&n.add(l)}return n}show({placed:e,places:t},n,s){for(let r of this.islands.keys()){let o=hn(this.atlas,r),a=(n.has(r)?i0:0)|(e.has(o)?s0:0)|(s.has(r)?r0:0);this.placed.put(r,t.get(o)??_n,a)}}dispose(){this.placed.texture.dispose()}};var Cw=[["Undo","Ctrl Z","undo"],["Redo","Ctrl Shift Z","redo"]],Pw=[["Grab","G","grab"],["Rotate","R","rotate"],["Scale","S","scale"]],Iw=[["Lock","L","lock"],["All","A","all"]],Lw=[["Make room","M","room"]],Nw={room:"The other islands make room while some are moved"},Dw=[["Click","select"],["Shift Click","more"],["G R S","grab, rotate, scale"],["X Y","along an axis"],["Enter","leave there"],["Esc","put back"],["L","lock"],["Tab","leave"]],Xc=class{#e;#t;constructor(e){let t=([s,r,o])=>Ge(s,()=>e(o),{title:`${Nw[o]??s} (${r})`,data:{does:o}}),n=(s,r)=>F("div",{className:"tools",aria:{role:"group",label:s}},...r.map(t));this.#e=Ge("Arrange",()=>e("toggle"),{id:"arrange",title:"Move islands by hand and pack the others around them (Tab)",aria:{pressed:"false"}}),this.#t=[n("Change",Cw),n("Move",Pw),n("Islands",Iw),n("Others",Lw),Ge("Bake",()=>e("bake"),{id:"arrange-bake",title:"Make a job of all islands where they lie (B)",data:{does:"bake"}}),Ge("Repack",()=>e("repack"),{id:"arrange-repack",className:"primary",title:"Pack the others around the locked islands (P)"})],$("toolbar").append(this.#e,...this.#t),$("arrange-hints").append(...Dw.flatMap(([s,r])=>[F("kbd",{textContent:s}),` ${r} `]))}refresh({isOn:e,isOffered:t,isBusy:n,hasSelected:s,gesture:r,makesRoom:o,canUndo:a,canRedo:l,canBake:c}){this.#e.disabled=!t,this.#e.setAttribute("aria-pressed",String(e)),$("toolbar").classList.toggle("arranging",e),$("arrange-hints").hidden=!e,$("faults").hidden=e;let h={undo:a,redo:l,grab:s,rotate:s,scale:s,lock:s,all:!0,room:r===null,bake:c,repack:!0};for(let u of this.#t){u.hidden=!e;for(let d of u.matches("button")?[u]:u.querySelectorAll("button"))d.disabled=n||!(h[d.dataset.does??"repack"]??!0),d.dataset.does&&d.setAttribute("aria-pressed",String(d.dataset.does===r||d.dataset.does==="room"&&o))}}};var qc=class{constructor(e,t){this.viewer=e;this.told=t;this.#e=new Xc(n=>this.does(n)),this.#t=new Pc($("plane"),this),addEventListener("beforeunload",n=>{[...this.#i.values()].some(s=>s.isUnsaved)&&n.preventDefault()}),addEventListener("pagehide",()=>this.#b())}viewer;told;isOn=!1;#e;#t;#i=new Map;#n=null;#s=null;#a=!1;#r=null;#o=new Set;#l=null;#c=!1;#h=null;#u=null;#d=!1;#f=new Set;offer(e,t){if(this.#d)return this.refresh();let{analysis:n,facts:s,model:r}=this.viewer,o=s!==null&&["glb","gltf"].includes(cn(s.source.name))&&(n?.atlases.some(({isMapped:a})=>a)??!1);this.#a=e?.state==="succeeded"&&t?.written?.primitives!==void 0&&o&&r!==null,this.#s=t,e&&this.#a?this.#p(e.id):this.leave(),this.refresh()}#p(e){this.#n?.now.job!==e&&(this.#n=this.#i.get(e)??new wc(e),this.#i.set(e,this.#n),this.#o.clear())}refresh(){let{stage:e,pointing:t}=this.viewer;t.taken=this.isOn?(r,o)=>this.#v(r?.face??null,o):null,this.isOn&&!this.#d&&this.#g(),e&&(e.uniforms.uArranging.value=Number(this.isOn&&this.#r!==null&&this.#r.analysis===this.viewer.analysis));let{canUndo:n=!1,canRedo:s=!1}=this.#n??{};this.#e.refresh({isOn:this.isOn,isOffered:this.#a,isBusy:this.#d,hasSelected:0<this.#o.size,gesture:this.#t.gesture,makesRoom:this.#c,canUndo:n,canRedo:s,canBake:this.#n?.isUnsaved??!1}),this.#y(),e?.redraw()}#g(){let{analysis:e,atlas:t,facts:n,model:s,stage:r}=this.viewer;!e||!n||!s||!r||((this.#r?.analysis!==e||this.#r.atlas!==t)&&(this.#r?.dispose(),this.#o.clear(),this.#r=new Wc(e,t,Kg(n)),r.uniforms.uPlaced.value=this.#r.placed.texture),this.#f=this.#r.faults(this.#m,this.#l?.of??null),this.#r.show({placed:this.#m,places:this.#_},this.#o,this.#f))}get#m(){let{now:e,places:t}=this.#n??{now:{placed:new Map},places:new Map};if(!this.#l)return e.placed;let n=ef(t,this.#x,this.#l.by);return new Map([...e.placed,...this.#x.map(s=>[s,n.get(s)])])}get#_(){return new Map([...this.#l?.followers??this.#n?.now.followers??[],...this.#m])}get#x(){return[...this.#o].map(e=>hn(this.viewer.atlas,e))}#y(){let e=$("panes").dataset;if(!this.isOn)return void["selected","locked","wrong","room"].forEach(l=>delete e[l]);let t=this.#r?.locked(this.#m)??[];Object.assign(e,{selected:[...this.#o].join(" "),locked:t.join(" "),wrong:[...this.#f].join(" ")}),this.#h?e.room=this.#h.isSettled?"settled":"moving":delete e.room;let{gesture:n}=this.#t,s=this.#l?.by??_n,r={grab:`moved by ${(s.s/this.aspect).toFixed(4)}, ${s.t.toFixed(4)}`,rotate:`turned by ${Mc(s).toFixed(1)}°`,scale:`scaled by ${ra(s).toFixed(3)}`},o=[...(this.#l?.followers??this.#n?.now.followers??new Map).values()].map(ra),a=Math.round(100*Math.min(1,...o));$("pointed").textContent=[this.#d?"Repacking …":"",this.#o.size?`${qt(this.#o.size,"island")} selected`:"Select islands by clicks",n?r[n]:"",a<100?`others at ${a} %`:"",t.length?`${t.length} locked`:"",this.#f.size?`${this.#f.size} too near to others or off the page`:""].filter(Boolean).join(" · ")}#v(e,t){let{analysis:n,atlas:s}=this.viewer;if(!n||this.#t.gesture||this.#d)return;let r=e!==null&&n.group[e]===s?n.chart[e]:null;t||this.#o.clear(),r!==null&&!(t&&this.#o.delete(r))&&this.#o.add(r),this.refresh()}get aspect(){return this.viewer.model?.aspect??1}inPlane([e,t]){return this.viewer.stage.plane.at(e,t)}onPage([e,t]){return this.viewer.stage.project("plane",new U(e,t,0))}moving(e){this.#l&&(this.#l.by=e,this.#h?.hold(this.#m),this.refresh())}ended(e){let t=this.#n,n=this.#l?.followers??null;this.#l=null,e&&t?(t.move(this.#x,e),n&&t.follow(n),this.#h?.hold(t.now.placed),this.#u=this.#h&&t.now):this.#A(),this.refresh()}#M(e){let t=this.#r;if(!this.#o.size||!t)return;let n=this.#_,s=[...this.#o].map(o=>t.at(o,n).box);this.#c&&this.#w(t);let r=this.#h?t.locked(this.#m):t.islands.keys();this.#l={by:_n,of:t.moving(this.#o,n,r),followers:null},this.#h?.begin(n,this.#u===this.#n.now,this.#m),this.#t.start(e,Tc(Ng(s)))}#w({islands:e,analysis:t,atlas:n}){let{facts:s}=this.viewer,{job:r}=this.#n.now,o=this.#s?.written?.primitives;if(!s||!o)return;let a=this.#h?.arranged;if(a?.job===r&&a.atlas===n&&a.analysis===t)return;this.#b();let l=new Fc({job:r,facts:s,primitives:o,atlas:n,analysis:t,islands:e},{follow:c=>this.#h===l&&this.#T(c),ended:c=>this.#h===l&&this.#E(c)});this.#h=l}#b(){let e=this.#h;this.#h=this.#u=null,e?.close()}#A(){this.#u=null,this.#h?.cancel()}#T(e){let t=this.#n;if(this.#l)this.#l.followers=e;else if(t&&this.#u===t.now)t.follow(e),this.#u=t.now;else return;this.refresh()}#E(e){this.#h=this.#u=null,e&&(this.#c=!1,this.told.failed(e)),this.refresh()}leave(){this.isOn&&(this.#t.end(!1),this.#b(),this.isOn=!1,this.told.changed())}does(e){if(e==="toggle"&&this.isOn)return this.leave();if(e==="toggle")return this.isOn=this.#a,this.told.changed();let t=this.#n;if(!this.isOn||this.#d||!t)return;let n=this.#t,s={x:()=>n.constrain(0),y:()=>n.constrain(1),confirm:()=>n.end(!0),cancel:()=>n.end(!1)},r={grab:()=>this.#M("grab"),rotate:()=>this.#M("rotate"),scale:()=>this.#M("scale"),cancel:()=>this.#o.clear(),all:()=>this.#r?.islands.forEach((o,a)=>this.#o.add(a)),lock:()=>this.#o.size&&this.#C(t),undo:()=>t.undo()&&void this.#S(),redo:()=>t.redo()&&void this.#S(),room:()=>this.#R(),bake:()=>t.isUnsaved&&void this.#I(this.#L),repack:()=>{this.#I(t.now.placed)}};(n.gesture?s:r)[e]?.(),this.refresh()}#R(){this.#c=!this.#c,this.#c&&this.#r?this.#w(this.#r):this.#b()}#C(e){let t=this.#u===e.now;e.lock(this.#x),this.#u=t&&0<e.now.followers.size?e.now:null}type(e){this.#t.type(e)}async#S(){let{job:e}=this.#n.now;this.#A(),this.#P(),e!==this.viewer.place.job&&(this.#b(),this.#d=!0,await this.told.open(e),this.#d=!1,this.told.changed())}#P(){let e=this.#n;this.#i.forEach((t,n)=>t===e&&this.#i.delete(n)),this.#i.set(e.now.job,e)}get#L(){let e=this.#_,t=new Set([...e.keys()].map(s=>s.split("/")[0])),n=this.viewer.analysis.atlases.flatMap(({charts:s},r)=>t.has(String(r))?Array.from({length:s},(o,a)=>hn(r,a)):[]);return new Map(n.map(s=>[s,e.get(s)??_n]))}async#I(e){let{analysis:t,facts:n,model:s}=this.viewer,r=this.#n;if(this.#f.size)return this.told.failed(new Error("Islands in red are too near to others that stay, or leave the page. Move them first."));let{primitives:o}=this.#s.written,a=Oc(n,o);if(!a)return this.told.failed(new Error("The primitives of this file have different UV sets: they cannot be packed together."));let l={islands:Gg(t,s.aspect,e,n,o),...a};this.#d=!0,this.refresh();try{let c=await Cg(await _c("repack",l,n.source)),h=r.now.job===this.viewer.place.job;r.baked(c.id),h?await this.#S():this.#P()}catch(c){this.told.failed(c)}this.#d=!1,this.told.changed()}};var $c=null;function d0(i){addEventListener("pointerdown",({target:e})=>$c=e.closest(".pane"),{capture:!0}),addEventListener("focusin",({target:e})=>{e.closest(".pane")!==$c&&($c=null)}),addEventListener("keydown",e=>{let t=e.target;if(t.matches("input:not([type=radio], [type=checkbox]), select, textarea")||e.altKey||document.querySelector("dialog[open]"))return;let s=e.ctrlKey||e.metaKey,r=t.closest(".pane"),o=i().find(({key:a,ctrl:l=!1,shift:c,inPane:h=!1,byPointer:u=!1})=>(!h||r!==null)&&(!u||r!==null&&r===$c)&&a.toLowerCase()===e.key.toLowerCase()&&l===s&&(c??e.shiftKey)===e.shiftKey);o&&(e.preventDefault(),o.act())})}function Uw({key:i,ctrl:e,shift:t}){let n=i===" "?"Space":i.length===1?i.toUpperCase():i;return[e&&"Ctrl",t&&"Shift",n].filter(Boolean).join(" ")}function bs(i){let e=$("keys"),t=[...i.filter(({isSaid:n})=>!n).map(n=>[Uw(n),n.does]),["Drag","Turn the surface, move the UVs"],["Right drag","Move the surface"],["Wheel","Zoom to the pointer"],["Click","Select; elsewhere, select nothing"]];e.replaceChildren(F("h2",{id:"keys-title",textContent:"Keys"}),F("dl",{className:"keys"},...t.map(([n,s])=>F("div",{},F("dt",{},F("kbd",{textContent:n})),F("dd",{textContent:s})))),Ge("Close",()=>e.close(),{className:"primary"})),e.showModal()}var Ow=[..."0123456789.-","Backspace"];function f0(i){let e=(n,s,r,o={})=>({key:n,does:s,act:()=>i.does(r),...o}),t=[e("g","Grab the selected islands: they follow the pointer until you click","grab"),e("r","Rotate them","rotate"),e("s","Scale them","scale"),e("x","Move along u only","x"),e("y","Move along v only","y"),{key:"0 … 9",does:"Type degrees, a factor, or a way along u or v",act:()=>{}},...Ow.map(n=>({key:n,does:"",act:()=>i.type(n),isSaid:!0})),e("Enter","Leave them there","confirm",{inPane:!0}),e("Escape","Put them back; select nothing","cancel"),e("l","Lock, or let go; what is moved is locked","lock"),e("a","Select all islands","all"),e("m","Let the other islands make room while some are moved, or not","room"),e("b","Bake: make a job of all islands where they lie","bake"),e("p","Repack the others around the locked ones","repack"),e("z","Undo","undo",{ctrl:!0,shift:!1}),e("z","Redo","redo",{ctrl:!0,shift:!0}),{key:"f",does:"Show everything",act:()=>i.viewer.frame()},e("Tab","Leave; the arrangement is kept","toggle",{shift:!1,inPane:!0,byPointer:!0}),{key:"?",does:"These keys",act:()=>bs(t)}];return t}var p0=5;function m0(i,e){let[t,n]=[$("divider"),$("panes")],s=o=>e({split:Math.round(Math.min(Math.max(o,100-ro),ro))});t.addEventListener("pointerdown",o=>t.setPointerCapture(o.pointerId)),t.addEventListener("pointermove",o=>{if(!t.hasPointerCapture(o.pointerId))return;let{left:a,width:l}=n.getBoundingClientRect();s(100*(o.clientX-a)/l)}),t.addEventListener("dblclick",()=>s(Kt.split)),t.addEventListener("keydown",({key:o})=>{let a={ArrowLeft:-p0,ArrowRight:p0}[o];a&&s(i.place.split+a)});let r=()=>{t.setAttribute("aria-valuenow",String(i.place.split))};i.show(r),r()}function g0(i){let[e,t]=[document.documentElement,$("drop")];for(let n of["dragenter","dragover"])e.addEventListener(n,s=>{s.preventDefault(),t.classList.add("over")});e.addEventListener("dragleave",n=>{n.relatedTarget||t.classList.remove("over")}),e.addEventListener("drop",n=>{n.preventDefault(),t.classList.remove("over"),i([...n.dataTransfer?.files??[]])})}var df={unwrap:"Options",repack:"RepackOptions",measure:"MeasureOptions",verify:"VerifyOptions"},x0={...df,solve:"SolveOptions",deform:"DeformOptions",warp:"WarpOptions",edit_uv:"EditOptions",texture_map:"EditOptions"},y0=null;function v0(){return y0??=ut("openapi.json").then(({components:i})=>i.schemas),y0}async function _0(i){let e=await v0(),t=e[x0[i]??"Options"]?.properties??{};return Object.entries(t).map(([n,s])=>Fw(n,s,e)).filter(n=>n!==null)}function Fw(i,e,t){let n=b0(e,t),s=n.flatMap(({type:a})=>a??[]);if(s.includes("array")||s.includes("object")&&!s.includes("string"))return null;let r=n.flatMap(({enum:a,description:l})=>(a??[]).filter(c=>c!==null).map(c=>({word:String(c),help:a?.length===1?l??"":""}))),o=a=>n.find(l=>l[a]!==void 0)?.[a];return{name:i,help:e.description??e.oneOf?.[0]?.description??"",words:r,default:e.default??null,control:0<r.length?"choice":s.includes("boolean")?"switch":s.includes("string")?"text":"number",minimum:o("minimum"),maximum:o("maximum"),isWhole:s.includes("integer")}}function b0(i,e){let n=[(i.$ref?e[i.$ref.split("/").pop()??""]:void 0)??[],i.oneOf??[],i.anyOf??[],i.allOf??[]].flat();return[i,...n.flatMap(s=>b0(s,e))]}async function Zr(i,e){let n=(await v0())[x0[i]??"Options"]?.properties??{},s=(r,o)=>JSON.stringify(n[r]?.default??null)===JSON.stringify(o);return Object.fromEntries(Object.entries(e).filter(([r,o])=>o!==null&&!s(r,o)))}var un=Uint8Array,kn=Uint16Array,xf=Int32Array,vf=new un([0,0,0,0,0,0,0,0,1,1,1,1,2,2,2,2,3,3,3,3,4,4,4,4,5,5,5,5,0,0,0,0]),_f=new un([0,0,0,0,1,1,2,2,3,3,4,4,5,5,6,6,7,7,8,8,9,9,10,10,11,11,12,12,13,13,0,0]),M0=new un([16,17,18,0,8,7,9,6,10,5,11,4,12,3,13,2,14,1,15]),C0=function(i,e){for(var t=new kn(31),n=0;n<31;++n)t[n]=e+=1<<i[n-1];for(var s=new xf(t[30]),n=1;n<30;++n)for(var r=t[n];r<t[n+1];++r)s[r]=r-t[n]<<5|n;return{b:t,r:s}},P0=C0(vf,2),Bw=P0.b,pf=P0.r;Bw[28]=258,pf[258]=28;var I0=C0(_f,0),m3=I0.b,S0=I0.r,mf=new kn(32768);for(ot=0;ot<32768;++ot)Zi=(ot&43690)>>1|(ot&21845)<<1,Zi=(Zi&52428)>>2|(Zi&13107)<<2,Zi=(Zi&61680)>>4|(Zi&3855)<<4,mf[ot]=((Zi&65280)>>8|(Zi&255)<<8)>>1;var Zi,ot,ha=(function(i,e,t){for(var n=i.length,s=0,r=new kn(e);s<n;++s)i[s]&&++r[i[s]-1];var o=new kn(e);for(s=1;s<e;++s)o[s]=o[s-1]+r[s-1]<<1;var a;if(t){a=new kn(1<<e);var l=15-e;for(s=0;s<n;++s)if(i[s])for(var c=s<<4|i[s],h=e-i[s],u=o[i[s]-1]++<<h,d=u|(1<<h)-1;u<=d;++u)a[mf[u]>>l]=c}else for(a=new kn(n),s=0;s<n;++s)i[s]&&(a[s]=mf[o[i[s]-1]++]>>15-i[s]);return a}),er=new un(288);for(ot=0;ot<144;++ot)er[ot]=8;var ot;for(ot=144;ot<256;++ot)er[ot]=9;var ot;for(ot=256;ot<280;++ot)er[ot]=7;var ot;for(ot=280;ot<288;++ot)er[ot]=8;var ot,Yc=new un(32);for(ot=0;ot<32;++ot)Yc[ot]=5;var ot,kw=ha(er,9,0);var zw=ha(Yc,5,0);var L0=function(i){return(i+7)/8|0},N0=function(i,e,t){return(e==null||e<0)&&(e=0),(t==null||t>i.length)&&(t=i.length),new un(i.subarray(e,t))};var Vw=["unexpected EOF","invalid block type","invalid length/literal","invalid distance","stream finished","no stream handler",,"no callback","invalid UTF-8 data","extra field too long","date not in range 1980-2099","filename too long","stream finishing","invalid zip data"],Kc=function(i,e,t){var n=new Error(e||Vw[i]);if(n.code=i,Error.captureStackTrace&&Error.captureStackTrace(n,Kc),!t)throw n;return n};var Qi=function(i,e,t){t<<=e&7;var n=e/8|0;i[n]|=t,i[n+1]|=t>>8},la=function(i,e,t){t<<=e&7;var n=e/8|0;i[n]|=t,i[n+1]|=t>>8,i[n+2]|=t>>16},ff=function(i,e){for(var t=[],n=0;n<i.length;++n)i[n]&&t.push({s:n,f:i[n]});var s=t.length,r=t.slice();if(!s)return{t:U0,l:0};if(s==1){var o=new un(t[0].s+1);return o[t[0].s]=1,{t:o,l:1}}t.sort(function(T,w){return T.f-w.f}),t.push({s:-1,f:25001});var a=t[0],l=t[1],c=0,h=1,u=2;for(t[0]={s:-1,f:a.f+l.f,l:a,r:l};h!=s-1;)a=t[t[c].f<t[u].f?c++:u++],l=t[c!=h&&t[c].f<t[u].f?c++:u++],t[h++]={s:-1,f:a.f+l.f,l:a,r:l};for(var d=r[0].s,n=1;n<s;++n)r[n].s>d&&(d=r[n].s);var f=new kn(d+1),y=gf(t[h-1],f,0);if(y>e){var n=0,x=0,m=y-e,g=1<<m;for(r.sort(function(w,p){return f[p.s]-f[w.s]||w.f-p.f});n<s;++n){var S=r[n].s;if(f[S]>e)x+=g-(1<<y-f[S]),f[S]=e;else break}for(x>>=m;x>0;){var M=r[n].s;f[M]<e?x-=1<<e-f[M]++-1:++n}for(;n>=0&&x;--n){var _=r[n].s;f[_]==e&&(--f[_],++x)}y=e}return{t:new un(f),l:y}},gf=function(i,e,t){return i.s==-1?Math.max(gf(i.l,e,t+1),gf(i.r,e,t+1)):e[i.s]=t},w0=function(i){for(var e=i.length;e&&!i[--e];);for(var t=new kn(++e),n=0,s=i[0],r=1,o=function(l){t[n++]=l},a=1;a<=e;++a)if(i[a]==s&&a!=e)++r;else{if(!s&&r>2){for(;r>138;r-=138)o(32754);r>2&&(o(r>10?r-11<<5|28690:r-3<<5|12305),r=0)}else if(r>3){for(o(s),--r;r>6;r-=6)o(8304);r>2&&(o(r-3<<5|8208),r=0)}for(;r--;)o(s);r=1,s=i[a]}return{c:t.subarray(0,n),n:e}},ca=function(i,e){for(var t=0,n=0;n<e.length;++n)t+=i[n]*e[n];return t},D0=function(i,e,t){var n=t.length,s=L0(e+2);i[s]=n&255,i[s+1]=n>>8,i[s+2]=i[s]^255,i[s+3]=i[s+1]^255;for(var r=0;r<n;++r)i[s+r+4]=t[r];return(s+4+n)*8},A0=function(i,e,t,n,s,r,o,a,l,c,h){Qi(e,h++,t),++s[256];for(var u=ff(s,15),d=u.t,f=u.l,y=ff(r,15),x=y.t,m=y.l,g=w0(d),S=g.c,M=g.n,_=w0(x),T=_.c,w=_.n,p=new kn(19),v=0;v<S.length;++v)++p[S[v]&31];for(var v=0;v<T.length;++v)++p[T[v]&31];for(var C=ff(p,7),R=C.t,I=C.l,D=19;D>4&&!R[M0[D-1]];--D);var B=c+5<<3,P=ca(s,er)+ca(r,Yc)+o,G=ca(s,d)+ca(r,x)+o+14+3*D+ca(p,R)+2*p[16]+3*p[17]+7*p[18];if(l>=0&&B<=P&&B<=G)return D0(e,h,i.subarray(l,l+c));var W,k,Q,q;if(Qi(e,h,1+(G<P)),h+=2,G<P){W=ha(d,f,0),k=d,Q=ha(x,m,0),q=x;var ee=ha(R,I,0);Qi(e,h,M-257),Qi(e,h+5,w-1),Qi(e,h+10,D-4),h+=14;for(var v=0;v<D;++v)Qi(e,h+3*v,R[M0[v]]);h+=3*D;for(var te=[S,T],_e=0;_e<2;++_e)for(var Ae=te[_e],v=0;v<Ae.length;++v){var Y=Ae[v]&31;Qi(e,h,ee[Y]),h+=R[Y],Y>15&&(Qi(e,h,Ae[v]>>5&127),h+=Ae[v]>>12)}}else W=kw,k=er,Q=zw,q=Yc;for(var v=0;v<a;++v){var re=n[v];if(re>255){var Y=re>>18&31;la(e,h,W[Y+257]),h+=k[Y+257],Y>7&&(Qi(e,h,re>>23&31),h+=vf[Y]);var ve=re&31;la(e,h,Q[ve]),h+=q[ve],ve>3&&(la(e,h,re>>5&8191),h+=_f[ve])}else la(e,h,W[re]),h+=k[re]}return la(e,h,W[256]),h+k[256]},Hw=new xf([65540,131080,131088,131104,262176,1048704,1048832,2114560,2117632]),U0=new un(0),Gw=function(i,e,t,n,s,r){var o=r.z||i.length,a=new un(n+o+5*(1+Math.ceil(o/7e3))+s),l=a.subarray(n,a.length-s),c=r.l,h=(r.r||0)&7;if(e){h&&(l[0]=r.r>>3);for(var u=Hw[e-1],d=u>>13,f=u&8191,y=(1<<t)-1,x=r.p||new kn(32768),m=r.h||new kn(y+1),g=Math.ceil(t/3),S=2*g,M=function(We){return(i[We]^i[We+1]<<g^i[We+2]<<S)&y},_=new xf(25e3),T=new kn(288),w=new kn(32),p=0,v=0,C=r.i||0,R=0,I=r.w||0,D=0;C+2<o;++C){var B=M(C),P=C&32767,G=m[B];if(x[P]=G,m[B]=P,I<=C){var W=o-C;if((p>7e3||R>24576)&&(W>423||!c)){h=A0(i,l,0,_,T,w,v,R,D,C-D,h),R=p=v=0,D=C;for(var k=0;k<286;++k)T[k]=0;for(var k=0;k<30;++k)w[k]=0}var Q=2,q=0,ee=f,te=P-G&32767;if(W>2&&B==M(C-te))for(var _e=Math.min(d,W)-1,Ae=Math.min(32767,C),Y=Math.min(258,W);te<=Ae&&--ee&&P!=G;){if(i[C+Q]==i[C+Q-te]){for(var re=0;re<Y&&i[C+re]==i[C+re-te];++re);if(re>Q){if(Q=re,q=te,re>_e)break;for(var ve=Math.min(te,re-2),Pe=0,k=0;k<ve;++k){var me=C-te+k&32767,Oe=x[me],St=me-Oe&32767;St>Pe&&(Pe=St,G=me)}}}P=G,G=x[P],te+=P-G&32767}if(q){_[R++]=268435456|pf[Q]<<18|S0[q];var Le=pf[Q]&31,nt=S0[q]&31;v+=vf[Le]+_f[nt],++T[257+Le],++w[nt],I=C+Q,++p}else _[R++]=i[C],++T[i[C]]}}for(C=Math.max(C,I);C<o;++C)_[R++]=i[C],++T[i[C]];h=A0(i,l,c,_,T,w,v,R,D,C-D,h),c||(r.r=h&7|l[h/8|0]<<3,h-=7,r.h=m,r.p=x,r.i=C,r.w=I)}else{for(var C=r.w||0;C<o+c;C+=65535){var st=C+65535;st>=o&&(l[h/8|0]=c,st=o),h=D0(l,h+1,i.subarray(C,st))}r.i=o}return N0(a,0,n+L0(h)+s)},Ww=(function(){for(var i=new Int32Array(256),e=0;e<256;++e){for(var t=e,n=9;--n;)t=(t&1&&-306674912)^t>>>1;i[e]=t}return i})(),Xw=function(){var i=-1;return{p:function(e){for(var t=i,n=0;n<e.length;++n)t=Ww[t&255^e[n]]^t>>>8;i=t},d:function(){return~i}}};var qw=function(i,e,t,n,s){if(!s&&(s={l:1},e.dictionary)){var r=e.dictionary.subarray(-32768),o=new un(r.length+i.length);o.set(r),o.set(i,r.length),i=o,s.w=r.length}return Gw(i,e.level==null?6:e.level,e.mem==null?s.l?Math.ceil(Math.max(8,Math.min(13,Math.log(i.length)))*1.5):20:12+e.mem,t,n,s)},O0=function(i,e){var t={};for(var n in i)t[n]=i[n];for(var n in e)t[n]=e[n];return t};var Zt=function(i,e,t){for(;t;++e)i[e]=t,t>>>=8};function $w(i,e){return qw(i,e||{},0,0)}var F0=function(i,e,t,n){for(var s in i){var r=i[s],o=e+s,a=n;Array.isArray(r)&&(a=O0(n,r[1]),r=r[0]),ArrayBuffer.isView(r)?t[o]=[r,a]:(t[o+="/"]=[new un(0),a],F0(r,o,t,n))}},T0=typeof TextEncoder<"u"&&new TextEncoder,Yw=typeof TextDecoder<"u"&&new TextDecoder,Kw=0;try{Yw.decode(U0,{stream:!0}),Kw=1}catch{}function E0(i,e){if(e){for(var t=new un(i.length),n=0;n<i.length;++n)t[n]=i.charCodeAt(n);return t}if(T0)return T0.encode(i);for(var s=i.length,r=new un(i.length+(i.length>>1)),o=0,a=function(h){r[o++]=h},n=0;n<s;++n){if(o+5>r.length){var l=new un(o+8+(s-n<<1));l.set(r),r=l}var c=i.charCodeAt(n);c<128||e?a(c):c<2048?(a(192|c>>6),a(128|c&63)):c>55295&&c<57344?(c=65536+(c&1047552)|i.charCodeAt(++n)&1023,a(240|c>>18),a(128|c>>12&63),a(128|c>>6&63),a(128|c&63)):(a(224|c>>12),a(128|c>>6&63),a(128|c&63))}return N0(r,0,o)}var yf=function(i){var e=0;if(i)for(var t in i){var n=i[t].length;n>65535&&Kc(9),e+=n+4}return e},R0=function(i,e,t,n,s,r,o,a){var l=n.length,c=t.extra,h=a&&a.length,u=yf(c);Zt(i,e,o!=null?33639248:67324752),e+=4,o!=null&&(i[e++]=20,i[e++]=t.os),i[e]=20,e+=2,i[e++]=t.flag<<1|(r<0&&8),i[e++]=s&&8,i[e++]=t.compression&255,i[e++]=t.compression>>8;var d=new Date(t.mtime==null?Date.now():t.mtime),f=d.getFullYear()-1980;if((f<0||f>119)&&Kc(10),Zt(i,e,f<<25|d.getMonth()+1<<21|d.getDate()<<16|d.getHours()<<11|d.getMinutes()<<5|d.getSeconds()>>1),e+=4,r!=-1&&(Zt(i,e,t.crc),Zt(i,e+4,r<0?-r-2:r),Zt(i,e+8,t.size)),Zt(i,e+12,l),Zt(i,e+14,u),e+=16,o!=null&&(Zt(i,e,h),Zt(i,e+6,t.attrs),Zt(i,e+10,o),e+=14),i.set(n,e),e+=l,u)for(var y in c){var x=c[y],m=x.length;Zt(i,e,+y),Zt(i,e+2,m),i.set(x,e+4),e+=4+m}return h&&(i.set(a,e),e+=h),e},jw=function(i,e,t,n,s){Zt(i,e,101010256),Zt(i,e+8,t),Zt(i,e+10,t),Zt(i,e+12,n),Zt(i,e+16,s)};function B0(i,e){e||(e={});var t={},n=[];F0(i,"",t,e);var s=0,r=0;for(var o in t){var a=t[o],l=a[0],c=a[1],h=c.level==0?0:8,u=E0(o),d=u.length,f=c.comment,y=f&&E0(f),x=y&&y.length,m=yf(c.extra);d>65535&&Kc(11);var g=h?$w(l,c):l,S=g.length,M=Xw();M.p(l),n.push(O0(c,{size:l.length,crc:M.d(),c:g,f:u,m:y,u:d!=o.length||y&&f.length!=x,o:s,compression:h})),s+=30+d+m+S,r+=76+2*(d+m)+(x||0)+S}for(var _=new un(r+22),T=s,w=r-s,p=0;p<n.length;++p){var u=n[p];R0(_,u.o,u,u.f,u.u,u.c.length);var v=30+u.f.length+yf(u.extra);_.set(u.c,u.o+v),R0(_,s,u,u.f,u.u,u.c.length,u.o,u.m),s+=16+v+(u.m?u.m.length:0)}return jw(_,s,n.length,w,T),_}function Ms(i){return i.state==="failed"||i.state==="cancelled"?i.state:i.certified===null?"done":i.certified?"certified":"open"}var Jw={read:"Reading the file",cut:"Finding seams",map:"Relaxing charts",deform:"Deforming",pack:"Packing the atlas",bake:"Resampling textures",write:"Writing the result",judge:"Proving the result"};function tr({stage:i,state:e}){return Rt(e)?"Fetching the result":Jw[i??""]??"Starting"}var Zw=200,Qw=3e3;function k0({metadata:i}){let{batch:e}=i;if(typeof e!="string")return null;let t=F("section",{className:"batch"});return z0(t,e),t}async function z0(i,e){let t=await eA(e).catch(()=>null);t&&i.replaceChildren(F("h2",{textContent:"Batch"}),...tA(t),nA(t,e)),!t?.every(({state:n})=>Rt(n))&&setTimeout(()=>{i.isConnected&&z0(i,e)},Qw)}async function eA(i){let e=new URLSearchParams({limit:String(Zw),metadata:JSON.stringify({batch:i})});return(await ut(`v1/jobs?${e}`)).jobs.reverse()}function tA(i){let e=s=>i.filter(r=>Rt(r.state)&&Ms(r)===s).length,t=[["Certified",e("certified")],["Not certified",e("open")],["Done",e("done")],["Failed",e("failed")],["Cancelled",e("cancelled")],["Not ended",i.filter(({state:s})=>!Rt(s)).length]],n=i.reduce((s,r)=>s+r.elapsed_ms,0);return[ui([["Jobs",String(i.length)],...t.filter(([,s])=>s).map(([s,r])=>[s,String(r)]),["Time in total",Ji(n)]])]}function nA(i,e){let t=i.filter(r=>Qn(r,"result")),n=Ge(`Download ${qt(t.length,"result")} as ZIP`,()=>{s().catch(()=>n.textContent="Not all results can be fetched. Try again")});n.disabled=!t.length;async function s(){let r=new Blob([B0(await iA(t),{level:0})],{type:"application/zip"}),o=F("a",{href:URL.createObjectURL(r),download:`${e.replaceAll(":","-")}.zip`});o.click(),setTimeout(()=>URL.revokeObjectURL(o.href))}return n}async function iA(i){let e={},t=new Set;for(let n of i){let s=n.links.files.filter(({href:l})=>l.endsWith("/result")||l.includes("/files/")),[r,o]=[s[0].name.replace(/\.[^.]*$/,""),s[0].name.replace(/^.*(?=\.)/,"")],a=r;for(let l=2;t.has(a);l++)a=`${r}-${l}`;t.add(a);for(let{href:l,name:c}of s)e[s.length===1?`${a}${o}`:`${a}/${c}`]=new Uint8Array(await(await _s(l)).arrayBuffer())}return e}function bf(i){return/^[\w@%+=:,./-]+$/.test(i)?i:`'${i.replaceAll("'","'\\''")}'`}function V0(i){return typeof i=="string"?i:JSON.stringify(i)}var sA={warp:"image",solve:"problem"};function H0(i,e,t){let n=new URL("v1/jobs",document.baseURI).href,s=[["-F",`kind=${i}`],["-F",`${sA[i]??"mesh"}=@${e}`]];Object.keys(t).length&&s.push(["-F",`options=${JSON.stringify(t)}`]);let r=ug()?['-H "Authorization: Bearer $UNWRAPD_KEY"']:[];return["curl -s",bf(n),...r,...s.flat().map(bf)].join(" ")}function G0(i,e,t){if(!["unwrap","repack","measure","verify"].includes(i)||"islands"in t)return null;let{format:n="glb",...s}=t,r=e.replace(/\.[^.]*$/,""),o=Object.entries(s).flatMap(([l,c])=>{let h=`--${l.replaceAll("_","-")}`;return c===!0?[h]:[h,V0(c)]}),a=i==="measure"||i==="verify"?[]:["-o",`${r}-${i}.${V0(n)}`];return["unwrapd",i==="measure"?"verify":i,e,...a,...o].map(bf).join(" ")}async function W0(i){try{return await navigator.clipboard.writeText(i),!0}catch{return!1}}var nr=320,Ss=96;function X0(i,e){let t=Math.max(...i.bins,1e-9),n=nr/i.bins.length,s=i.bins.map((a,l)=>{let c=a===0?0:Math.max(Ss*a/t,1);return jn("rect",{x:l*n+.5,y:Ss-c,width:n-1,height:c})}),r=Math.min(Math.max((i.mean-i.from)/(i.to-i.from)*nr,0),nr),o=`${e}: from ${et(i.least)} to ${et(i.greatest)}, mean ${et(i.mean)}`;return jn("svg",{viewBox:`0 0 ${nr} ${Ss+16}`,role:"img","aria-label":o,class:"histogram"},...s,jn("line",{x1:r,x2:r,y1:0,y2:Ss,class:"mean"}),jn("text",{x:0,y:Ss+13},et(i.from)),jn("text",{x:nr,y:Ss+13,"text-anchor":"end"},et(i.to)))}function q0(i,e){let t=i.map(a=>Math.log(Math.max(a,1e-300))),[n,s]=[Math.min(...t),Math.max(...t)],r=t.map((a,l)=>`${l/Math.max(t.length-1,1)*nr},${4+(Ss-8)*(1-(a-n)/(s-n||1))}`),o=`${e}: from ${et(i[0])} to ${et(i.at(-1))}`;return jn("svg",{viewBox:`0 0 ${nr} ${Ss}`,role:"img","aria-label":o,class:"curve",preserveAspectRatio:"none"},jn("polyline",{points:r.join(" ")}))}function jc({locally_injective:i,bijective:e,stacks:t,unmirrored:n,padding:s,aligned:r,pages:o,safe_bits:a,bits:l}){let c=[{holds:i,text:"No face is flipped or without area",detail:"Judged in exact arithmetic on the bytes of the file."},rA(e,t??null),oA(n,t??null)];if(s){let h=s.reached_texels===null?"":` The nearest two are ${s.reached_texels.toFixed(2)} texels apart.`;c.push({holds:s.kept,text:`Charts keep ${s.asked_texels} texels at ${s.resolution}`,detail:`No color bleeds from one chart into another.${h}`})}return r!==null&&c.push({holds:r,text:"Charts end on borders of texels",detail:"Light does not leak across their edges."}),o&&1<o.asked&&c.push({holds:o.kept,text:`Each chart lies on one of ${o.asked} pages`,detail:`${o.used} are used.`}),l?c.push({holds:l.hold,text:`Safe when rounded to ${l.asked} bits`,detail:"Nothing flips or overlaps when an engine stores fewer digits."}):a&&c.push({holds:!0,text:`Safe when rounded to ${a} bits`,detail:"Nothing flips or overlaps when an engine stores that many digits or more."}),c}function rA(i,e){if(i||!e?.stacks)return{holds:i,text:"No two faces overlap",detail:"Each point of the texture belongs to one place of the surface."};let t=e.stacks===1?"1 stack":`${e.stacks} stacks`;return{holds:e.kept,text:`No two faces overlap except in ${t}`,detail:`${e.charts} charts share texels on purpose: those of a stack coincide exactly.`}}function oA(i,e){return i||!e?.stacks?{holds:i,text:"No chart is mirrored",detail:"Text in a texture reads the right way around."}:{holds:e.unmirrored,text:"No chart is mirrored except in stacks",detail:"Text in a texture reads the right way around elsewhere."}}function Jc({holds:i,text:e}){return i?e:`Not so: ${e.charAt(0).toLowerCase()}${e.slice(1)}`}function ua(i){return i?.groups?.filter(({measures:e})=>e)??[]}function ei(i,e){let t=i.measures?.[e];return typeof t=="number"?t:null}var Zc=class{constructor(e,t){this.job=e;this.actions=t;this.#o=e,this.#s=Ge("Finish early",()=>{this.#h()},{title:"Take the current map, which is valid, as the result"}),this.#l=Ge("Cancel",t.cancel),$("inspector").replaceChildren(F("section",{className:"progress-panel"},this.#i,this.#t,F("div",{className:"actions"},this.#s,this.#l),this.#a,this.#n,this.#c),...K0(e)),this.show(e)}job;actions;#e=[];#t=F("progress",{max:1,value:0,aria:{label:"Share of the work done"}});#i=F("p",{className:"stage",aria:{role:"status"}});#n=F("div");#s;#a=F("p",{className:"hint",aria:{role:"status"}});#r=!1;#o;#l;#c=F("div",{className:"energies",title:"Energy of the chart at hand, iteration by iteration"});async#h(){this.#r=!0,this.show(this.#o),await this.actions.finish().catch(()=>this.#r=!1),this.show(this.#o)}show(e){this.#o=e;let t=this.actions.position();this.#i.textContent=e.state==="queued"?t?`Number ${t} in the queue`:"In the queue":tr(e),this.#t.value=e.fraction,this.#s.textContent=this.#r?"Finishing …":"Finish early",this.#s.disabled=this.#r||Rt(e.state),this.#l.disabled=Rt(e.state),this.#a.textContent=this.#r&&!Rt(e.state)?"The current map becomes the result as soon as the step under way is done.":"";let n=e.stage==="map"||e.stage==="deform";n&&e.energy!==null&&this.#e.push(e.energy),this.#n.replaceChildren(ui([["Done",vn(e.fraction)],["Time",Ji(e.elapsed_ms)],["Maps made",e.charts?`${e.chart} of ${e.charts} so far`:"–","Pieces that are cut again are mapped again"],["Iteration",n?vt(e.iteration):"–"],["Energy",n?et(e.energy):"–"],["Smallest face",n?et(e.smallest):"–","As a share of its rest area: positive means that nothing is flipped"]])),1<this.#e.length&&this.#c.replaceChildren(q0(this.#e.slice(-200),"Energy"))}};async function Y0(i,e,t){let n=await Zr(i.kind,i.options).catch(()=>({})),s=[aA(i),hA(i),uA(i),e?.proven?dA(e):null];e&&s.push(fA(e)),i.warnings.length&&s.push(ir("Warnings",F("ul",{className:"warnings"},...i.warnings.map(r=>cA(r,t))))),i.links.files.length&&s.push(ir("Files",pA(i))),s.push(ir("Job",mA(i,n),F("div",{className:"actions"},i.state==="failed"?Ge("Retry",t.retry):null,Ge("Use these options",t.reuse,{title:"Put the options of this job into the form"}),Ge("Delete",t.remove,{className:"danger"})),gA(i,n)),k0(i),...K0(i)),$("inspector").replaceChildren(...s.filter(r=>r!==null))}function ir(i,...e){return F("section",{},F("h2",{textContent:i}),...e)}function aA(i){let e=Ms(i),t={certified:"Certified",open:"Not certified",failed:"Failed",cancelled:"Cancelled",done:i.kind==="measure"?"Measured":"Done"}[e],n={certified:"Everything requested is proven on the bytes of the file.",open:"The result exists, but something requested is not proven. The warnings say what.",failed:"",cancelled:"Only the record is kept.",done:i.kind==="measure"?"The UVs of the file as they are.":""}[e];return F("section",{className:`verdict ${e}`},F("h2",{textContent:t}),n?F("p",{textContent:n}):null)}var lA={uvs_beside_set_0:{label:"Move the textures to the new UVs",more:{rebake:!0}}};function cA({code:i,message:e},t){let n=lA[i];return F("li",{},...hc(e),n?Ge(n.label,()=>t.again(n.more)):null)}function hA({accept:i,accepted:e}){return i===null||e===null?null:F("section",{className:`verdict ${e?"certified":"open"}`},F("h2",{textContent:e?"Accepted":"Not accepted"}),F("p",{textContent:`The job ${e?"meets":"does not meet"} every gate: ${i.replaceAll(",",", ")}.`}))}function K0({metadata:i}){let e=Object.entries(i).map(([t,n])=>[t,typeof n=="string"?n:JSON.stringify(n)]);return e.length?[ir("Metadata",ui(e))]:[]}function uA({error:i}){return i?F("section",{className:"failure"},F("p",{},F("strong",{textContent:i.title})),F("p",{textContent:i.detail}),F("p",{className:"hint"},"Repair the file or change the options, then try again. ",F("a",{href:`docs#${i.code}`,textContent:`About ${i.code}`}))):null}function dA(i){let e=jc(i.proven).map(({holds:t,text:n,detail:s})=>F("li",{className:t?"holds":"fails",title:s},F("span",{className:"tick",aria:{hidden:"true"},textContent:t?"✓":"✕"}),F("span",{textContent:Jc({holds:t,text:n,detail:s})})));return ir("Proven",F("ul",{className:"claims"},...e))}function fA(i){let e=ua(i);if(!e.length)return i.groups?null:ir("Report",Mf(i));let t=o=>e.reduce((a,l)=>a+(ei(l,o)??0),0),n=t("area_3d")||1,s=o=>e.reduce((a,l)=>a+(ei(l,o)??0)*(ei(l,"area_3d")??0),0)/n,[r]=e;return ir(e.length===1?"Result":`Result: ${e.length} atlases`,ui([["Faces",vt(t("faces"))],["Charts",vt(t("charts"))],["Seams / √area",et(t("seam_length")/Math.sqrt(n)),"Length of all seams over the square root of the surface area"],["Distortion",et(s("sym_dirichlet_mean")),"Mean symmetric Dirichlet energy; an isometry has 4"],["Covered",vn(t("pack_unit")/e.length),"Share of the texture that charts cover"],["Texels per unit",e.length===1?et(r.texels_per_unit):"by atlas"]]))}function Mf(i){let e=Object.entries(i).filter(([t,n])=>!["schema_version","unwrapd_version"].includes(t)&&["number","string","boolean"].includes(typeof n));return ui(e.map(([t,n])=>[Ai(t),typeof n=="number"?et(n):typeof n=="boolean"?n?"yes":"no":String(n)]))}function pA(i){return F("ul",{className:"files"},...i.links.files.map(({href:e,name:t,bytes:n},s)=>F("li",{},F("a",{href:Et(e),download:t,className:s?"":"primary",textContent:t}),F("small",{textContent:n===void 0?"":ji(n)}))))}function mA(i,e){let t=Object.entries(e).map(([n,s])=>`${Ai(n).toLowerCase()} ${typeof s=="object"?"…":s}`).join(", ");return ui([["Kind",Ai(i.kind)],...i.owner?[["Owner",i.owner]]:[],["Options",t||"defaults"],["Input",ji(i.input_bytes)],["Time",Ji(i.elapsed_ms)],["Made",new Date(i.created_at).toLocaleString()],["Kept until",i.expires_at?new Date(i.expires_at).toLocaleDateString():"–"],...i.cached?[["Result","copied from an equal job"]]:[]])}function gA(i,e){let t=G0(i.kind,i.filename,e);return F("div",{className:"actions"},$0("Copy as curl",H0(i.kind,i.filename,e)),t?$0("Copy as command",t):null)}function $0(i,e){let t=Ge(i,()=>{W0(e).then(n=>{t.textContent=n?"Copied":"Not allowed here",setTimeout(()=>t.textContent=i,1500)})},{title:e});return t}async function j0(i,e,t){let n=Qn(i,"result");if(i.kind==="warp"&&n)return{pictures:[...i.links.inputs.slice(0,1).map(({href:a})=>[Et(a),"Before"]),[Et(n.href),"After"]]};if(!n){let o={padding:Number(i.options.padding??0),resolution:i.options.resolution??1024};return t&&jr.includes(cn(t.name))?{surface:{...t,model:fi(i),record:o}}:{nothing:"This job has no mesh to show. Its report is beside."}}if(!jr.includes(cn(n.name)))return{nothing:`There is no view of ${cn(n.name)} files here. Download ${n.name}, or see the report.`};let s=i.links.files.filter(({href:o})=>o.includes("/files/")),r=await _s(n.href);return{surface:{name:n.name,model:fi(i),content:r,resources:await Z0(s),...yA(e)}}}function yA(i){let e=i?.written?.primitives;if(!e?.length)return{};let t=new Map(e.map(({mesh:n,primitive:s,texcoord:r})=>[`${n}/${s}`,r]));return{texcoord:(n,s)=>t.get(`${n}/${s}`)??e[0].texcoord}}async function J0(i){let[e,...t]=i.links.inputs;return!e||!jr.includes(cn(e.name))?null:{name:e.name,content:await _s(e.href),resources:await Z0(t)}}async function Z0(i){return new Map(await Promise.all(i.map(async({href:e,name:t})=>[t,await _s(e)])))}function Q0(i){let e=new DataView(i),t=[];for(let n=16;n<i.byteLength;){let[s,r,o,a,l,c,h,u]=[0,4,8,12,16,20,24,28].map(g=>e.getUint32(n+g,!0)),d=e.getFloat64(n+32,!0),f=n+56,y=f+4*l;n=y+6*l*h;let x=i.slice(y,n),m=h===4?new Float32Array(x):new Float64Array(x);t.push({surface:s,first:r,iteration:o,total:a,flips:c,isPlan:u===1,unit:d,faces:new Uint32Array(i.slice(f,y)),corners:m})}return{number:e.getBigUint64(8,!0).toString(),maps:t}}var xA=`
uniform vec3 uPlace;
out vec3 vCorner;
void main() {
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position.xy * uPlace.z + uPlace.xy, 0.0, 1.0);
}`,vA=`
precision highp float;
precision highp int;
${Bc}
uniform uint uChart;
in vec3 vCorner;
layout(location = 0) out vec4 color;
void main() {
  vec3 width = fwidth(vCorner);
  vec3 inside = smoothstep(width * 0.4, width * 1.2, vCorner);
  float strength = 0.42 * clamp(1.0 - 2.2 * max(width.x, max(width.y, width.z)), 0.0, 1.0);
  color = vec4(chartColor(uChart) * (1.0 - strength * (1.0 - min(inside.x, min(inside.y, inside.z)))), 1.0);
}`,_A=.06,Qc=class{#e=new Map;#t=new Map;#i=0;#n=[1,1];take(e){let t=`${e.surface}/${e.first}`;this.#s(e,t);let s=this.#e.get(t)?.mesh??this.#r();s.geometry.dispose(),s.geometry=bA(e),this.#e.set(t,{map:e,mesh:s,box:MA(e),place:[0,0]})}#s({surface:e,faces:t},n){let s=this.#t.get(e)??new Map;this.#t.set(e,s);for(let r of t){let o=s.get(r);o!==void 0&&o!==n&&this.#a(o),s.set(r,n)}}#a(e){let t=this.#e.get(e);if(!t)return;this.#e.delete(e),ey(t.mesh);let n=this.#t.get(t.map.surface);for(let s of t.map.faces)n.get(s)===e&&n.delete(s)}#r(){let e={uPlace:{value:[0,0,1]},uChart:{value:this.#i++}},t=new je(new Je,new An({glslVersion:Ks,vertexShader:xA,fragmentShader:vA,uniforms:e,side:Lt,depthTest:!1,blending:ci}));return t.frustumCulled=!1,t}arrange(){let e=[...this.#e.values()],t=new Map(e.map(h=>[h,SA(h)]));e.sort((h,u)=>t.get(u)[1]-t.get(h)[1]);let n=e.reduce((h,u)=>h+t.get(u)[0]*t.get(u)[1],0),s=e.reduce((h,u)=>Math.max(h,t.get(u)[0]),0),r=Math.max(s,1.1*Math.sqrt(n)),[o,a,l]=[0,0,0];for(let h of e){let[u,d]=t.get(h);0<o&&r<o+u&&([o,a,l]=[0,a+l,0]),h.place=[o+u/2,a+d/2],o+=u,l=Math.max(l,d)}this.#n=[r,a+l];let c=1/Math.max(...this.#n,Number.MIN_VALUE);for(let{map:h,mesh:u,box:[d,f,y,x],place:[m,g]}of e){let S=h.unit*c,M=u.material.uniforms;M.uPlace.value=[m*c-(d+y)/2*S,1-g*c-(f+x)/2*S,S]}}get meshes(){return[...this.#e.values()].map(({mesh:e})=>e)}get count(){return this.#e.size}get flips(){return[...this.#e.values()].reduce((e,{map:t})=>e+t.flips,0)}get isPlan(){return[...this.#e.values()].some(({map:e})=>e.isPlan)}get share(){let e=[...this.#e.values()],t=n=>e.reduce((s,{map:r})=>s+n(r),0);return t(({faces:n})=>n.length)/Math.max(t(({total:n})=>n),1)}dispose(){this.meshes.forEach(ey),this.#e.clear(),this.#t.clear()}};function ey({geometry:i,material:e}){i.dispose(),e.dispose()}function bA({corners:i}){let e=new Float32Array(i.length/2*3);for(let n=0;n<i.length/2;n++)e[3*n]=i[2*n],e[3*n+1]=i[2*n+1];let t=new Je;return t.setAttribute("position",new ze(e,3)),t}function MA({corners:i}){let e=[1/0,1/0,-1/0,-1/0];for(let t=0;t<i.length;t+=2)e[0]=Math.min(e[0],i[t]),e[1]=Math.min(e[1],i[t+1]),e[2]=Math.max(e[2],i[t]),e[3]=Math.max(e[3],i[t+1]);return e}function SA({map:i,box:[e,t,n,s]}){let r=_A*Math.max(n-e,s-t);return[(n-e+r)*i.unit,(s-t+r)*i.unit]}var wA=500;function ty(i,e,t){let n=new AbortController;return i.kind==="unwrap"&&e.stage&&AA(i,e,t,n.signal).catch(()=>{}),()=>n.abort()}async function AA(i,e,t,n){let s=new Qc;for(let r="0";!n.aborted;){let o=await Eg(i,r,n).catch(l=>{if(l instanceof Ki&&l.problem.status<500)throw l;return"gone"});if(n.aborted)return;if(o==="elsewhere")return t();if(o==="gone"&&(r="0"),o==="none"||o==="gone"){await new Promise(l=>setTimeout(l,wA));continue}let a=Q0(o);r=a.number,a.maps.forEach(l=>s.take(l)),s.arrange(),e.relax(s,TA(s))}}function TA({count:i,flips:e,share:t,isPlan:n}){let s=t<1?`, ${vn(t)} of the faces drawn`:"";return`${vt(i)} ${i===1?"chart":"charts"}, as the solver has them · ${vt(e)} flips${s}${n?" · seams of large charts are planned on a simplified copy":""}`}var eh=class{#e;#t=()=>{};#i=()=>{};#n=new Map;#s=new Map;#a="after";constructor(e){this.#e=e,e.store.show(()=>this.#u())}remember(e,t){t&&this.#n.set(e.id,t),this.#s.set(e.id,e)}listed(e){let t=e.find(({id:n})=>n===this.#e.store.job?.id);t&&this.#i(t)}#r(e){let{subject:t}=this.#e.store.state;return t.kind==="job"&&t.job===e?t:null}#o(e,t){let n=this.#r(e);n&&this.#e.store.change({subject:{...n,...t}})}leave(){this.#t(),this.#t=()=>{},this.#i=()=>{},da(null)}async open(e){let{store:t,viewer:n}=this.#e;this.leave(),t.job?.id!==e&&n.calm();let s=this.#s.get(e);this.#s.delete(e);let r=s??await ut(Rg(e));if(this.#e.list.take(r),t.place.job!==e)return;let{subject:o}=t.state,a=this.#n.get(e)??(o.kind==="job"&&o.job.id===e?o.input:null);if(t.change({subject:{kind:"job",job:r,report:null,input:a}}),Rt(r.state))return this.#h(r);let l=new Zc(r,this.#p(r));ti(Sf(r,r)),this.#c(r);let[c,h]=[r,!1],u=ty(r,n,()=>{h=!0,this.#r(r)&&!Rt(c.state)&&ti(Sf(r,c,h))}),d=r.seq-1;this.#i=y=>{!this.#r(r)||y.seq<=d||([d,c]=[y.seq,y],l.show(y),this.#e.list.heard(e,y),n.isRelaxing||ti(Sf(r,y,h)),Rt(y.state)&&(this.open(e).catch(this.#e.failed),this.#e.list.refresh()))};let f=jd(r,y=>this.#i(y));this.#t=()=>{u(),f()}}async#l(e){return this.#r(e)?.input??await J0(e).catch(()=>null)}async#c(e){let t=await this.#l(e);!this.#r(e)||!t||(this.#o(e,{input:t}),await this.#e.viewer.show({...t,model:fi(e),isTurning:!0,isInput:!0}).catch(()=>{}))}async#h(e){let t=e.state==="succeeded"&&Qn(e,"report")?await ut(`${e.links.self}/report`):null;if(!this.#r(e))return;this.#o(e,{report:t}),this.#e.ended(),await Y0(e,t,this.#p(e));let n=await this.#l(e);if(this.#r(e)){if(this.#o(e,{input:n}),this.#a=this.#e.store.place.uvs,e.state!=="succeeded"){this.#e.viewer.calm(),ti(e.state==="failed"?"No result: the job failed. The cause is beside.":"No result: the job was cancelled."),n?await this.#e.viewer.show({...n,model:fi(e)}).catch(()=>{}):this.#e.viewer.clear();return}await this.#d(e)}}#u(){let{store:e,failed:t}=this.#e,{job:n}=e;!n||e.place.uvs===this.#a||!this.before()||(this.#a=e.place.uvs,this.#d(n).catch(t))}async#d(e){let{store:t,viewer:n}=this.#e,s=t.place.uvs==="after"?null:this.before();if(t.place.uvs!=="both"&&await n.showBeside(null),s&&t.place.uvs==="before"){await n.show(s)&&ti(n.analysis?.atlases.some(({isMapped:o})=>o)?"":"The input has no UVs.");return}let r=this.#r(e);r&&await this.#f(e,await j0(e,r.report,r.input)),s&&this.#r(e)&&t.place.uvs==="both"&&await n.showBeside(s)}async#f(e,t){if(!this.#r(e))return;let{viewer:n}=this.#e;ti("surface"in t?"Looking at the result …":""),"surface"in t?(await n.show(t.surface)&&ti(n.analysis?.atlases.some(({isMapped:s})=>s)?"":"This file has no UVs."),n.stage||da(e,"This browser shows no WebGL here: pictures instead of views.")):(n.clear(),"pictures"in t?RA(t.pictures):ti(t.nothing))}before(){let{subject:e}=this.#e.store.state;if(e.kind!=="job"||!e.input||!e.report)return null;let{job:t,input:n,report:s}=e,{padding:r=0,resolution:o=1024,group_by:a,source_texcoord:l}=t.options,c=s.options?.group_by??a??"material";return{...n,model:fi(t),record:{padding:Number(r),resolution:o,group_by:c,texcoord:Number(l??0)}}}#p(e){let{failed:t,list:n,setup:s,removed:r,made:o}=this.#e,a=l=>{l.then(()=>n.refresh()).catch(t)};return{cancel:()=>a(ut(Et(e.links.self),{method:"DELETE"})),finish:async()=>{await ut(`${e.links.self}/finish`,{method:"POST"}).catch(l=>{throw t(l),l})},again:l=>a(EA(e,l).then(c=>o([{job:c,input:this.#r(e)?.input??null}]))),retry:()=>a(ut(`${e.links.self}/retry`,{method:"POST"}).then(()=>this.open(e.id))),remove:()=>{n.remove(e),r()},reuse:()=>{s.take(e.kind,e.options).catch(t)},position:()=>n.position(e.id)}}};async function EA(i,e){return bc(i,i.kind,{...await Zr(i.kind,i.options),...e})}function Sf({kind:i},e,t=!1){if(e.state==="queued")return"The job waits for its turn.";if(Rt(e.state))return`${tr(e)} …`;let n=t?"Another machine computes this job: its UVs appear here when it ends.":i==="unwrap"?"Charts appear here as soon as the first one is planned.":"The result appears here when the job ends.";return`${tr(e)}, ${vn(e.fraction)} done. ${n}`}function ti(i){$("plane-note").textContent=i}function da(i,e=""){let t=$("fallback"),n=i?i.links.files.filter(({name:s})=>s.endsWith(".png")&&s!=="thumbnail.png"):[];t.hidden=i===null,t.replaceChildren(F("p",{textContent:e}),...n.map(({href:s,name:r})=>F("img",{src:Et(s),alt:r})))}function RA(i){let e=$("fallback");e.hidden=!1,e.replaceChildren(...i.map(([t,n])=>F("figure",{},F("img",{src:t,alt:n}),F("figcaption",{textContent:n}))))}var CA=400;function ny(i,e){let t=0;e.onFrame=()=>{clearTimeout(t),t=setTimeout(()=>i.keepCameras(),CA)};let n=$("canvas");n.addEventListener("webglcontextlost",s=>{s.preventDefault(),da(i.store.job,"The graphics device was lost. Pictures are shown until it is back; the report is complete.")}),n.addEventListener("webglcontextrestored",()=>{da(null),e.restore()})}var PA=36e5;function IA(i){try{return JSON.parse(i)}catch{return i}}function LA(i){let e=i.split(",").map(t=>t.split(/=(.*)/s).map(n=>n.trim()));return Object.fromEntries(e.filter(([t,n])=>t&&n).map(([t,n])=>[t,IA(n)]))}var th=class{#e=$("filter-state");#t=$("filter-kind");#i=$("filter-since");#n=$("filter-metadata");constructor(e){$("filters").addEventListener("change",()=>{$("filtered").textContent=this.isAny?"on":"",e()})}get isAny(){return this.query()!==""}query(){let e=LA(this.#n.value),t={state:this.#e.value,kind:this.#t.value,created_from:this.#i.value&&new Date(Date.now()-Number(this.#i.value)*PA).toISOString(),metadata:Object.keys(e).length?JSON.stringify(e):""};return Object.entries(t).filter(([,n])=>n).map(([n,s])=>`&${n}=${encodeURIComponent(s)}`).join("")}};var iy="data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";function sy(i){let e=Qn(i,"thumbnail.png"),t=F("img",{width:36,height:36,alt:"",loading:"lazy",src:e?Et(e.href):iy});return t.addEventListener("error",()=>t.src=iy,{once:!0}),t}var ry=20,NA=1500,DA=15e3,UA=1e4,nh=class{constructor(e,t,n){this.store=e;this.chosen=t;this.listed=n;addEventListener("pagehide",()=>this.#l()),$("older").addEventListener("click",()=>{this.#c()}),e.show(()=>this.#s!==e.place.job&&this.#u()),document.addEventListener("visibilitychange",()=>document.hidden||void this.refresh())}store;chosen;listed;#e=[];#t=null;#i=[];#n=0;#s=null;#a=0;#r=new th(()=>{this.#a++,this.#e=[],this.#t=null,this.refresh()});#o=null;async refresh(){clearTimeout(this.#n);let e=this.#a;try{let n=await this.#h();if(e!==this.#a)return;let s=this.#e.filter(a=>n.jobs.length===ry&&!n.jobs.some(({id:l})=>l===a.id)&&a.created_at<n.jobs.at(-1).created_at);s.length||(this.#t=n.next);let r=new Map(this.#e.map(a=>[a.id,a])),o=n.jobs.map(a=>a.seq<(r.get(a.id)?.seq??0)?r.get(a.id):a);this.#e=[...o,...s],this.listed(this.#e),this.#i=n.jobs.some(({state:a})=>a==="queued")?await OA():[],this.#u()}catch{}let t=!Zs.isUp||this.#e.some(({state:n})=>!Rt(n));document.hidden||(this.#n=setTimeout(()=>{this.refresh()},t?NA:DA))}position(e){let t=this.#i.indexOf(e);return 0<=t?t+1:null}find(e){return this.#e.find(t=>t.id===e)??null}add(e){this.#e=[...e,...this.#e],this.#u()}heard(e,t){Rt(t.state)||(this.#e=this.#e.map(n=>n.id===e&&n.seq<t.seq?{...n,...t}:n),this.#u())}take(e){this.#e=this.#e.map(t=>t.id===e.id&&t.seq<=e.seq?e:t),this.#u()}remove(e){this.#l(),this.#o={job:e,timer:setTimeout(()=>this.#l(),UA)};let t=Ge("Undo",()=>{clearTimeout(this.#o?.timer),this.#o=null,$("removed").hidden=!0,this.#u(),this.chosen(e.id)});$("removed").replaceChildren(F("span",{textContent:`${e.filename} is deleted, with its files.`}),t),$("removed").hidden=!1,this.#u()}#l(){let{job:e,timer:t}=this.#o??{};e&&(clearTimeout(t),this.#o=null,$("removed").hidden=!0,this.#e=this.#e.filter(({id:n})=>n!==e.id),ut(Et(e.links.self),{method:"DELETE",keepalive:!0}).catch(()=>{}).then(()=>this.refresh()))}async#c(){let e=this.#a,t=await this.#h(`&cursor=${this.#t}`);e===this.#a&&(this.#e.push(...t.jobs),this.#t=t.next,this.#u())}#h(e=""){return ut(`v1/jobs?limit=${ry}${this.#r.query()}${e}`)}#u(){this.#s=this.store.place.job;let e=$("job-list"),t=new Map([...e.children].map(r=>[r.dataset.id,r])),n=this.#e.filter(({id:r})=>r!==this.#o?.job.id);e.replaceChildren(...n.map(r=>{let o=t.get(r.id),a=JSON.stringify([Ms(r),r.state,r.stage,Math.round(r.fraction*100),this.position(r.id),this.#s===r.id,Jd(r.created_at)]);return o?.dataset.key===a?o:this.#d(r,a)}));let s=this.#r.isAny?"No job meets the filter.":"None yet. Press Unwrap to make one of the sample.";n.length||e.replaceChildren(F("li",{className:"none",textContent:s})),$("older").hidden=this.#t===null}#d(e,t){let n=F("a",{href:`#${Vh({...Kt,job:e.id})}`,className:"row-link"},sy(e),F("span",{className:"name",textContent:e.filename,title:e.filename}),F("span",{className:`facts ${Ms(e)}${e.accepted===!1?" refused":""}`,textContent:this.#f(e)}));e.id===this.#s&&n.setAttribute("aria-current","true"),n.addEventListener("click",r=>{r.preventDefault(),this.chosen(e.id)});let s=F("progress",{max:1,value:e.fraction,hidden:e.state!=="running",aria:{label:`Progress of ${e.filename}`}});return F("li",{data:{id:e.id,key:t}},n,s)}#f(e){let t=e.kind==="unwrap"?"":`${Ai(e.kind)} · `;if(e.state==="queued"){let r=this.position(e.id);return`${t}${r?`number ${r} in the queue`:"queued"}`}if(e.state==="running")return`${t}${tr(e)} · ${vn(e.fraction)}`;let n={certified:"certified",open:"not certified",failed:"failed",cancelled:"cancelled",done:"done"}[Ms(e)],s=e.accepted===!1?" · not accepted":"";return`${t}${n}${s} · ${Ji(e.elapsed_ms)} · ${Jd(e.created_at)}`}};async function OA(){let{jobs:i}=await ut("v1/jobs?state=queued&limit=200"),e=(t,n)=>n.priority-t.priority||t.created_at.localeCompare(n.created_at);return i.sort(e).map(({id:t})=>t)}var In=["sym-dirichlet","angle","area","density"];function fa(i,e){if(i!=="sym-dirichlet")return e-1;let t=Math.max(e/4,1);return Math.sqrt(t+Math.sqrt(t*t-1))-1}function wf(i,e){let t=i.count,n=new Float64Array(t),s=new Float64Array(t),r=new Float32Array(4*t).fill(Number.NaN),o=new Float64Array(2*t);for(let l=0;l<t;l++){let c=FA(i,l,e);n[l]=c.area,s[l]=c.area*c.determinant||0,o[2*l]=c.squares,o[2*l+1]=c.determinant}let a=BA(i,n,s);for(let l=0;l<t;l++){let c=a[i.group[l]],[h,u]=[o[2*l]/c,Math.abs(o[2*l+1])/c];if(!(0<u)||!(0<n[l]))continue;let d=f=>Math.sqrt(Math.max(h+f*2*u,0));r[4*l]=h+h/u**2,r[4*l+1]=(d(1)+d(-1))**2/(4*u),r[4*l+2]=Math.max(u,1/u),r[4*l+3]=Math.sqrt(u*c)}return{values:r,area:n,texels:s}}function FA(i,e,{width:t,height:n}){let s=i.positions,r=9*e,[o,a,l]=[s[r+3]-s[r],s[r+4]-s[r+1],s[r+5]-s[r+2]],[c,h,u]=[s[r+6]-s[r],s[r+7]-s[r+1],s[r+8]-s[r+2]],d=Math.hypot(a*u-l*h,l*c-o*u,o*h-a*c),f=Math.hypot(o,a,l),y=(o*c+a*h+l*u)/f,x=d/f,m=i.uvs,g=6*e,[S,M]=[(m[g+2]-m[g])*t,(m[g+3]-m[g+1])*n],[_,T]=[(m[g+4]-m[g])*t,(m[g+5]-m[g+1])*n],[w,p]=[S/f,M/f],[v,C]=[(_-w*y)/x,(T-p*y)/x];return{area:d/2,squares:w*w+p*p+v*v+C*C,determinant:w*C-p*v}}function BA(i,e,t){let n=[],s=[];for(let r=0;r<i.count;r++){if(!(0<e[r])||!t[r])continue;let o=i.group[r];n[o]=(n[o]??0)+e[r],s[o]=(s[o]??0)+Math.abs(t[r])}return n.map((r,o)=>s[o]/r)}var Ti=["plain","charts","checker","heat","image","material"];function pa(){let i=new Fn(new Uint8Array([255,255,255,255]),1,1);return i.needsUpdate=!0,{uValues:{value:i},uIds:{value:i},uShade:{value:0},uMeasure:{value:0},uRange:{value:new Ee(0,1)},uChecker:{value:new Ee(32,32)},uImage:{value:i},uHover:{value:new it(-1,-1,-1,-1)},uSelected:{value:new it(-1,-1,-1,-1)},uOnly:{value:new Ee(-1,-1)},uAtlas:{value:0},uAspect:{value:1},uWire:{value:0},uProblems:{value:1},uSeams:{value:1},uArranging:{value:0},uPlaced:{value:i},uViewport:{value:new Ee(1,1)},uPixelRatio:{value:1}}}function oy(i){let{uValues:e,uIds:t,uAtlas:n,uAspect:s,uChecker:r,uHover:o,uSelected:a,uOnly:l,uArranging:c}=pa();return{...i,uValues:e,uIds:t,uAtlas:n,uAspect:s,uChecker:r,uHover:o,uSelected:a,uOnly:l,uArranging:c}}var ay={plain:"Plain",charts:"Charts",checker:"Checker",heat:"Heat map",image:"Image",material:"Material"},Af={"sym-dirichlet":"Symmetric Dirichlet",angle:"Angle",area:"Area",density:"Texel density"},ly={face:"Face",chart:"Chart",seam:"Seam"},cy={seams:"Seams",wire:"Wire",problems:"Problems",only:"Isolate"},kA=[["solid","3D","The surface alone (M)"],["plane","UV","The UVs alone (M)"]],sh=class{#e;#t;#i;#n;#s=F("select",{id:"fill",title:"Fill (C)",aria:{label:"Fill"}},...Ti.map(e=>F("option",{value:e,textContent:ay[e]})));#a=F("select",{id:"atlas",aria:{label:"Atlas"}});#r=F("select",{id:"set",title:"UV set of the file (T)",aria:{label:"UV set"}});#o=F("input",{type:"file",accept:"image/*",hidden:!0,aria:{label:"Image for the faces"}});constructor(e,t,n){this.#e=e,this.#t=t,this.#s.addEventListener("change",()=>this.#c(this.#s.value)),this.#a.addEventListener("change",()=>t({atlas:this.#a.value,face:null,chart:null,seam:null,plane:null})),this.#r.addEventListener("change",()=>t(Tf(e,Number(this.#r.value)))),this.#o.addEventListener("change",()=>{this.#u()}),this.#i=Ge("Before",()=>n("before"),{className:"comparing",title:"The UVs that the input had (B)",aria:{pressed:"false"}}),this.#n=Ge("Side by side",()=>n("both"),{title:"The UVs of the result above those of the input, with one camera and one scale (D)",className:"comparing",aria:{pressed:"false"}}),$("toolbar").append(this.#s,ih("Fill",...Ti.map(s=>this.#l("shade",s,ay[s]))),ih("Alone",...kA.map(([s,r,o])=>Ge(r,()=>t({alone:e.place.alone===s?null:s}),{title:o,data:{alone:s},aria:{pressed:"false"}}))),Ge("Frame",()=>e.frame(),{title:"Show everything (F)"}),this.#i,this.#n,this.#r,this.#a,this.#o),$("pointed").after(ih("Point at",...Object.keys(ly).map(s=>this.#l("aim",s,ly[s])))),$("faults").after(ih("Show",...Object.keys(cy).map(s=>this.#h(s))))}#l(e,t,n){return Ge(n,()=>e==="shade"?this.#c(t):this.#t({aim:t}),{data:{[e]:t},aria:{pressed:"false"}})}#c(e){this.#s.value=this.#e.place.shade,e==="image"?this.#o.click():this.#t({shade:e})}#h(e){return Ge(cy[e],()=>this.#t({[e]:!this.#e.place[e]}),{data:{switch:e},aria:{pressed:"false"}})}async#u(){let e=this.#o.files?.[0];this.#o.value="",e&&(await this.#e.useImage(e),this.#t({shade:"image"}))}refresh(e){let{place:t,analysis:n}=this.#e;for(let r of $("view").querySelectorAll(".tools button")){let{shade:o,aim:a,alone:l,switch:c}=r.dataset;r.setAttribute("aria-pressed",String(o===t.shade||a===t.aim||l===(t.alone??"")||c!==void 0&&t[c]))}this.#s.value=t.shade,this.#i.setAttribute("aria-pressed",String(t.uvs==="before")),this.#n.setAttribute("aria-pressed",String(t.uvs==="both")),this.#i.disabled=this.#n.disabled=!e;let s=n?.atlases??[];this.#a.replaceChildren(...s.map(({name:r,label:o,charts:a,isMapped:l})=>F("option",{value:r,textContent:`${o} · ${l?qt(a,"chart"):"no UVs"}`}))),this.#a.value=s[this.#e.atlas]?.name??"",this.#a.hidden=s.length<2,this.#d()}#d(){let{sets:e=[],set:t=0,first:n,source:s}=this.#e.facts??{},r=o=>o===n&&s?.texcoord?" · new":"";this.#r.replaceChildren(...e.map(o=>F("option",{value:String(o),textContent:`UV set ${o}${r(o)}`}))),this.#r.value=String(t),this.#r.hidden=e.length<2}};function Tf({facts:i},e){return{set:e===i?.first?null:e,atlas:null,face:null,chart:null,seam:null,plane:null}}function ih(i,...e){return F("div",{className:"tools",aria:{role:"group",label:i}},...e)}function uy(i){let{job:e,report:t}=i,n=i.analysis?.atlases[i.atlas],s=[F("h2",{className:"first",textContent:e.filename}),t?.proven?zA(jc(t.proven),t.certified):null,VA(i),n?.isMapped?HA(n):null,n?.isMapped&&i.analysis?GA(i.analysis,n,i.flyTo):null,ua(t).length?WA(ua(t)):null,t&&!t.groups?ws("Numbers",Mf(t)):null,XA(e),t?.seconds?qA(t.seconds):null];$("report").replaceChildren(F("div",{className:"sheet"},...s.filter(r=>r!==null)))}function ws(i,...e){return F("section",{},F("h3",{textContent:i}),...e)}function zA(i,e){let t=i.map(({holds:s,text:r,detail:o})=>F("li",{className:s?"holds":"fails"},F("span",{className:"tick",aria:{hidden:"true"},textContent:s?"✓":"✕"}),F("div",{},F("b",{textContent:Jc({holds:s,text:r,detail:o})}),F("p",{textContent:o})))),n=e==null?"What is proven":e?"Certified":"Not certified";return ws(n,F("ul",{className:"certificate"},...t))}function rh(i,e){return F("div",{className:"scroll",tabIndex:0,aria:{role:"region",label:i[0]||"Table"}},F("table",{},F("thead",{},F("tr",{},...i.map(t=>F("th",{scope:"col",textContent:t})))),F("tbody",{},...e.map(([t,...n])=>F("tr",{},F("th",{scope:"row"},t),...n.map(s=>F("td",{},s)))))))}function VA({analysis:i,before:e}){return!i||!e?.atlases.some(({isMapped:n})=>n)?null:ws("Before and after",rh(["","Before","After"],[["Charts",({charts:n})=>vt(n)],["Seam length",({seamLength:n})=>et(n)],["Mean symmetric Dirichlet",n=>et(hy(n,0))],["Mean angle distortion",n=>et(hy(n,1))],["Covered share of the texture",({atlases:n})=>vn(n.reduce((s,{fill:r})=>s+r,0)/n.length)],["Flipped faces",({atlases:n})=>vt(n.reduce((s,{flipped:r})=>s+r,0))],["Overlapping pairs",({atlases:n})=>vt(n.reduce((s,{overlapping:r})=>s+r,0))]].map(([n,s])=>[n,s(e),s(i)])))}function hy({atlases:i},e){let t=i.filter(({spreads:s})=>s[e]),n=t.reduce((s,r)=>s+r.area,0);return t.reduce((s,r)=>s+r.area*r.spreads[e].mean,0)/n}function HA({spreads:i,label:e}){let t=In.map((n,s)=>{let r=i[s];if(!r)return null;let o=Af[n];return F("figure",{},F("figcaption",{},F("b",{textContent:o}),` mean ${et(r.mean)}, 99 % below ${et(r.p99)}`),X0(r,o))});return ws(`How distortion is spread: ${e}`,F("div",{className:"figures"},...t))}function GA({values:i,chart:e},{spreads:t},n){let s=(t[0]?.worst??[]).map(r=>[Ge(`Face ${vt(r)}`,()=>n(r),{className:"link",title:"Show it in both views"}),vt(e[r]+1),...[0,1,2,3].map(o=>et(i[4*r+o]))]);return ws("Worst faces",rh(["Face","Chart",...In.map(r=>Af[r])],s))}function WA(i){let e=[["Faces",t=>vt(ei(t,"faces")??0)],["Charts",t=>vt(ei(t,"charts")??0)],["Seams / √area",t=>et(ei(t,"seam_over_sqrt_area"))],["Mean energy",t=>et(ei(t,"sym_dirichlet_mean"))],["99 % below",t=>et(ei(t,"sym_dirichlet_p99"))],["Covered",t=>vn(ei(t,"pack_unit")??0)],["Texels per unit",t=>et(t.texels_per_unit)],["Overlaps",t=>vt(ei(t,"overlap_pairs")??0)]];return ws("Atlases",rh(["Atlas",...e.map(([t])=>t)],i.map(t=>[t.label,...e.map(([,n])=>n(t))])))}function XA(i){let t=[["layout.png","UV layout"],["heatmap.png","Heat map"]].map(([n,s])=>{let r=Qn(i,n);if(!r)return null;let o=F("img",{src:Et(r.href),alt:`${s} of ${i.filename}`,loading:"lazy",width:512,height:512});return F("figure",{},F("a",{href:Et(r.href)},o),F("figcaption",{textContent:s}))});return t.some(Boolean)?ws("Pictures",F("div",{className:"figures"},...t)):null}function qA(i){return ws("Time",rh(["Stage","Wall clock"],Object.entries(i).filter(([,e])=>typeof e=="number").map(([e,t])=>[Ai(e),Ji(1e3*t)])))}var ft=(i,e)=>({label:i,unit:e}),dy={"Texture and packing":{padding:ft("Padding","px"),mips:ft("Padding holds for mips","levels"),texels_per_unit:ft("Texel density","px/unit"),pages:ft("UDIM tiles"),rotate:ft("Rotate islands"),packing:ft("Packing effort")},"Seams and stretch":{quality:ft("Stretch or seams"),cut:ft("Where to cut"),max_charts:ft("Islands at most"),max_stretch:ft("Stretch at most","× length"),seam_weight:ft("Cost of a seam","× usual"),symmetry:ft("Mirror symmetry"),material_borders:ft("Cut between materials")},"UV sets and textures":{texcoord:ft("Write to UV set"),source_texcoord:ft("Take islands of UV set"),overwrite:ft("Overwrite the UV set"),rebake:ft("Move the textures"),bake_size:ft("Size of moved textures","px"),image_format:ft("Format of moved textures")},Proof:{bijective:ft("No overlaps"),unmirrored:ft("No mirrored islands"),aligned:ft("Islands end on texels"),bits:ft("Safe when rounded to","bits"),quantization_safe:ft("Safe when rounded to","bits"),skip_missing:ft("Leave out parts without UVs"),separate_nodes:ft("Judge each node")},File:{format:ft("File format"),group_by:ft("One atlas per")}},oh="More options",fy=[...Object.keys(dy),oh];function Ef(i){let e=Object.entries(dy).find(([,t])=>i in t);return e?{group:e[0],words:e[1][i]}:{group:oh,words:null}}function Rf(i,e,t){let{[e]:n,...s}=i;return t===null||t===""||t===!1?s:{...s,[e]:t}}var ah=class{constructor(e,t){this.holder=e;this.changed=t}holder;changed;#e="";#t={};#i="";#n=F("p",{className:"help",hidden:!0,aria:{role:"status"},textContent:"No option has these words."});#s=new Map;async show(e,t,n){if(this.#t=t,e===this.#e)return this.#a();this.#e=e;let s=await _0(e).catch(c=>{throw this.#e="",c});if(e!==this.#e)return;this.#s.clear();let r=s.filter(({name:c})=>!n.includes(c)).map(c=>({...Ef(c.name),row:this.#r(c)})),o=fy.map(c=>({name:c,own:r.filter(({group:h})=>h===c).map(({row:h})=>h)}));this.holder.replaceChildren(...o.filter(({own:c})=>c.length).map(({name:c,own:h},u)=>F("details",{className:"group",open:u===0,data:{group:c}},F("summary",{textContent:c}),...h)),this.#n),this.#a();let a=new Set(s.map(({name:c})=>c)),l=Object.entries(this.#t).filter(([c])=>a.has(c));l.length<Object.keys(this.#t).length&&this.changed(Object.fromEntries(l))}#a(){for(let[e,t]of this.#s){let n=this.#t[e];t instanceof HTMLInputElement&&t.type==="checkbox"?t.checked=n===!0:document.activeElement!==t&&(t.value=n===void 0?"":String(n))}this.filter(this.#i)}filter(e){let t=e.trim().toLowerCase(),n=t!==this.#i;this.#i=t;let s=0;for(let r of this.holder.querySelectorAll(".group")){let o=[...r.querySelectorAll(".option")],a=r.dataset.group===oh;for(let c of o){let h=c.dataset.option,u=`${h} ${c.textContent}`.toLowerCase().includes(t);c.hidden=t?!u:a&&!(h in this.#t)}let l=o.filter(({hidden:c})=>!c).length;s+=l,r.hidden=l===0,n&&t&&(r.open=!0)}this.#n.hidden=0<s||!t}#r(e){let{name:t,help:n,control:s}=e,r=YA(e);r.id=`option-${t}`,r.setAttribute("aria-describedby",`help-${t}`),r.addEventListener("input",()=>{let c=r instanceof HTMLInputElement&&r.type==="checkbox";this.changed(Rf(this.#t,t,c?r.checked:s==="number"&&r.value!==""?Number(r.value):r.value))}),this.#s.set(t,r);let{words:o}=Ef(t),a=F("label",{htmlFor:r.id,title:`${t} in the API`},o?.label??Ai(t),o?.unit?F("small",{textContent:` ${o.unit}`}):null),l=F("p",{id:`help-${t}`,className:"help"},...hc(n.replaceAll(`
`," ").replaceAll("_"," ")));return F("div",{className:`option ${s}`,data:{option:t}},a,r,l)}};function $A(i,e){return i==="cut"&&e==="seams"}function YA({name:i,control:e,words:t,default:n,minimum:s,maximum:r,isWhole:o}){if(e==="choice"){let a=F("option",{value:"",textContent:n===null?"automatic":`${n}`}),l=t.filter(({word:c})=>c!==String(n)&&!$A(i,c));return F("select",{},a,...l.map(({word:c,help:h})=>F("option",{value:c,textContent:c,title:h})))}return e==="switch"?F("input",{type:"checkbox"}):e==="text"?F("input",{type:"text",placeholder:n===null?"automatic":String(n)}):F("input",{type:"number",placeholder:n===null?"automatic":String(n),min:s===void 0?"":String(s),max:r===void 0?"":String(r),step:o?"1":"any"})}var KA=["unwrap","repack","measure","verify","edit_uv","texture_map"],jA=["resolution"],JA=[...jr,"msh","mesh","vtk","zip"];function Cf({subject:i,chosen:e}){if(i.kind!=="job")return{files:e};let{job:t,input:n}=i;return KA.includes(t.kind)?t.state!=="cancelled"?{job:t,input:n}:n?{files:[n]}:{none:"The files of a cancelled job are removed. Choose the mesh again."}:{none:"The job on screen has no surface to unwrap."}}var lh=class{constructor(e,t){this.store=e;this.told=t;this.#e=new ah($("options"),n=>e.change({options:n})),this.#i(),e.show(()=>this.#n())}store;told;#e;choose(e){this.store.change({chosen:e}),e[0]&&this.told.shown(e[0])}async take(e,t){let n=Object.entries(t).filter(s=>s[1]!==null&&typeof s[1]!="object");this.store.change({kind:e in df?e:"unwrap",options:await Zr(e,Object.fromEntries(n))})}#t(e,t){this.store.change({options:Rf(this.store.state.options,e,t)})}ask(){$("files").click()}takeFiles(e){let t=e.filter(s=>JA.includes(cn(s.name))),n=new Map(e.filter(s=>!t.includes(s)).map(s=>[s.webkitRelativePath||s.name,s]));if(!t.length){this.told.failed(new Error(`None of these ${e.length} files is a mesh. Choose GLB, glTF, OBJ, PLY, STL or OFF, or one of them with its files in a ZIP.`));return}this.choose(t.map(s=>({name:s.name,content:s,resources:n})))}#i(){let e=$("setup"),t=$("files");t.addEventListener("change",()=>{t.files?.length&&this.takeFiles([...t.files]),t.value=""}),$("choose").addEventListener("click",()=>this.ask()),e.addEventListener("invalid",({target:n})=>{$("more").open=!0,$("find-option").value="",this.#e.filter("");let s=n.closest("details.group");s&&(s.open=!0),n.scrollIntoView({block:"nearest"})},{capture:!0}),e.addEventListener("submit",n=>{n.preventDefault(),this.submit()});for(let n of e.querySelectorAll("input[name=purpose]"))n.addEventListener("change",()=>{this.#t("preset",n.value==="lightmap"?"lightmap":null),this.#t("quality",n.value==="few"?"few":null)});$("resolution").addEventListener("change",()=>this.#t("resolution",ZA($("resolution").value))),$("keep").addEventListener("change",()=>this.#t("cut",$("keep").checked?"keep":null)),$("kind").addEventListener("change",()=>this.store.change({kind:$("kind").value})),$("find-option").addEventListener("input",()=>this.#e.filter($("find-option").value)),$("reset").addEventListener("click",()=>this.store.change({options:{}})),$("more").addEventListener("toggle",()=>this.#n())}#n(){let{kind:e,options:t,chosen:n,subject:s}=this.store.state,r=e==="unwrap";$("more").open&&this.#e.show(e,t,jA).catch(c=>this.told.failed(c)),$("kind").value=e,$("purpose").disabled=!r,$("keep").disabled=!r;let o=t.preset==="lightmap"?"lightmap":t.quality==="few"?"few":"material";$(`purpose-${o}`).checked=!0,$("keep").checked=t.cut==="keep",this.#a(String(t.resolution??"1024"));let a=Object.keys(t).length;$("changed").textContent=a?`${qt(a,"option")} set`:"",$("reset").hidden=a===0,this.#s();let l=s.kind==="file"?s.file:null;$("chosen").replaceChildren(...n.map(c=>this.#r(c,c===l)))}#s(){let{kind:e}=this.store.state,t=Cf(this.store.state),n={unwrap:"Unwrap",repack:"Repack",measure:"Measure",verify:"Verify"}[e],s="files"in t?t.files:[];$("submit").textContent=1<s.length?`${n} ${qt(s.length,"file")}`:"job"in t&&t.job.kind===e?`${n} again`:n,$("submit").disabled=this.#o||"none"in t,$("target").textContent="none"in t?t.none:"job"in t?`The input of this job: ${t.job.filename}`:""}#a(e){let t=$("resolution");[...t.options].some(n=>n.value===e)||t.append(F("option",{value:e,textContent:e})),t.value=e}#r(e,t){let n=Ge("×",()=>{let o=this.store.state.chosen.filter(a=>a!==e);this.store.change({chosen:o}),t&&o[0]&&this.told.shown(o[0])},{className:"bare",aria:{label:`Remove ${e.name}`}}),s=e.resources.size?` + ${e.resources.size}`:"",r=Ge(e.name,()=>this.told.shown(e),{className:"name",title:`Look at ${e.name}`,aria:t?{current:"true"}:{}});return F("li",{title:e.name},r,F("small",{textContent:`${ji(e.content.size)}${s}`}),n)}#o=!1;async submit(e={}){if(this.#o||!$("setup").reportValidity())return;let{kind:t,options:n}=this.store.state,s=Cf(this.store.state);if("none"in s)return this.told.failed(new Error(s.none));if("files"in s&&!s.files.length)return this.ask();let r={...n,...e},o=[];this.#c(!0);try{"job"in s?o.push({job:await bc(s.job,t,r),input:s.input}):await this.#l(s.files,(a,l,c)=>_c(t,r,a,l,c).then(h=>o.push({job:h,input:a})))}catch(a){a instanceof DOMException&&a.name==="AbortError"||this.told.failed(a)}finally{this.#c(!1),o.length&&this.told.made(o)}}async#l(e,t){let n=new AbortController,[s,r]=[$("sent"),$("sent-text")];$("cancel-sending").onclick=()=>n.abort();let o=1<e.length?{batch:`${new Date().toISOString().slice(0,19)}Z`}:{};for(let[a,l]of e.entries()){let c=1<e.length?`${a+1} of ${e.length}: `:"",h=(u,d)=>{s.value=d?u/d:0,r.textContent=`${c}${ji(u)} of ${ji(d)} sent`};h(0,l.content.size),await t(l,o,{progressed:h,signal:n.signal})}}#c(e){this.#o=e,$("sending").hidden=!e||"job"in Cf(this.store.state),this.#s()}};function ZA(i){return i==="1024"?null:/^\d+$/.test(i)?Number(i):i}function py(i){return i===0?"uv":i<4?`uv${i}`:`texcoord_${i}`}function my(i){let e=new Set;return i.traverse(t=>{for(let n of Object.keys(t.geometry?.attributes??{})){let s=/^(?:uv|texcoord_)(\d*)$/.exec(n)?.[1];s!==void 0&&e.add(Number(s))}}),[...e].sort((t,n)=>t-n)}function ma(i,{record:e,texcoord:t}){i.scene.updateMatrixWorld(!0);let n=[],s=[],r=new Map,o=e.separate_nodes===!0,a=0;return i.scene.traverse(l=>{let c=l;if(!c.isMesh)return;let h=eT(i,c)??{mesh:a++,primitive:0,material:null,name:c.name,materialName:""},u=`${h.mesh}/${h.primitive}`,d=tT(s,e.group_by??(i.parser?"mesh":"scene"),h),f=o?-1:r.get(u)??-1;r.set(u,r.get(u)??n.length),n.push({...nT(c,t(h.mesh,h.primitive),i.parser!==null),matrix:c.matrixWorld.toArray(),mesh:h.mesh,primitive:h.primitive,group:d,copyOf:f})}),{parts:n,groups:s,texture:QA(e),inScene:o}}function gy({parts:i}){let e=0;return i.filter(({copyOf:t})=>t<0).map(({mesh:t,primitive:n,positions:s})=>{let r=s.length/9;return e+=r,{mesh:t,primitive:n,begin:e-r,count:r}})}function QA({resolution:i=1024,padding:e=0}){let[t=1024,n=t]=String(i).split("x").map(Number);return{width:t,height:n,padding:e}}function eT({parser:i},e){let t=i?.associations.get(e);if(!i||t?.meshes===void 0)return null;let{meshes:n,materials:s}=i.json,r=t.primitives??0,o=n[t.meshes],a=o.primitives[r]?.material??null;return{mesh:t.meshes,primitive:r,material:a,name:o.name||`mesh ${t.meshes}`,materialName:a===null?"":s?.[a]?.name||`material ${a}`}}function tT(i,e,t){let[n,s]={scene:["scene","Whole scene"],mesh:[`mesh${t.mesh}`,t.name],primitive:[`mesh${t.mesh}/prim${t.primitive}`,`${t.name}, primitive ${t.primitive}`],material:t.material===null?[`mesh${t.mesh}`,t.name]:[`material${t.material}`,t.materialName]}[e],r=i.findIndex(o=>o.name===n);return 0<=r?r:i.push({name:n,label:s})-1}function nT(i,e,t){let{geometry:n}=i,s=iT(n),r=Pf(n,py(e),s,2);if(r&&t)for(let o=1;o<r.length;o+=2)r[o]=1-r[o];return{positions:sT(i,s),uvs:r,normals:yy(i)?null:Pf(n,"normal",s,3)}}function iT({index:i,attributes:e}){let t=i?i.count:e.position?.count??0;return Uint32Array.from({length:t-t%3},(n,s)=>i?i.getX(s):s)}function Pf({attributes:i},e,t,n){let s=i[e];if(!s)return null;let r=new Float32Array(n*t.length);return t.forEach((o,a)=>{r[n*a]=s.getX(o),r[n*a+1]=s.getY(o),n===3&&(r[3*a+2]=s.getZ(o))}),r}function yy(i){return i.isSkinnedMesh===!0||(i.morphTargetInfluences?.some(Boolean)??!1)}function sT(i,e){if(!yy(i))return Pf(i.geometry,"position",e,3);let t=new Float32Array(3*e.length),n=new U;return e.forEach((s,r)=>i.getVertexPosition(s,n).toArray(t,3*r)),t}var rT=1e-9;function If(i,e,t){let n=e.filter(l=>Lf(i,l)),s=new Float64Array(4*n.length),r=0;n.forEach((l,c)=>{oT(i.uvs,l,s,4*c),r+=Math.max(s[4*c+2]-s[4*c],s[4*c+3]-s[4*c+1])});let o=Math.max(2*r/Math.max(n.length,1),1e-6),a=0;return Vc(s,o,(l,c)=>{let[h,u]=[n[l],n[c]];xy(i.uvs,h,u)||xy(i.uvs,u,h)||(a+=1,t(h,u))}),a}function Lf({uvs:i},e){for(let t=6*e;t<6*e+6;t++)if(!Number.isFinite(i[t]))return!1;return!0}function oT(i,e,t,n){let s=6*e;for(let r=0;r<2;r++){let[o,a,l]=[i[s+r],i[s+r+2],i[s+r+4]];t[n+r]=Math.min(o,a,l),t[n+r+2]=Math.max(o,a,l)}}function xy(i,e,t){let[n,s]=[6*e,6*t];for(let r=0;r<6;r+=2){let[o,a,l]=[n+r,n+(r+2)%6,n+(r+4)%6],c=ch(i,o,a,l);if(c===0)return!0;let h=Math.sign(c);if(Math.max(h*ch(i,o,a,s),h*ch(i,o,a,s+2),h*ch(i,o,a,s+4))<=rT*((i[a]-i[o])**2+(i[a+1]-i[o+1])**2))return!0}return!1}function ch(i,e,t,n){let[s,r]=[i[e],i[e+1]];return(i[t]-s)*(i[n+1]-r)-(i[t+1]-r)*(i[n]-s)}var f2=Math.cos(Math.PI/4);function _y(i,{least:e,mean:t,greatest:n,p99:s},r){let o=r==="fixed";if(i==="density"){let a=o?2:Math.max(n/t,t/e,1.02);return[t/a,t*a]}return[0,o?1:Math.max(fa(i,s),.01)]}var by=16;var Nf={"sym-dirichlet":{name:"Stretch",help:"By how much lengths are stretched or compressed, from the symmetric Dirichlet energy"},angle:{name:"Angle stretch",help:"By how much a face is longer along one axis than along the other"},area:{name:"Area stretch",help:"By how much areas are larger or smaller than on average"},density:{name:"Texel density",help:"Pixels of the texture per unit of length"}};function Df(i){let{pointing:e,place:t,analysis:n,model:s}=i,r=n?cT(n,e.hovered?.face??t.face,t.chart)||hT(n,s!==null):"";$("pointed").textContent=[lT(i),r].filter(Boolean).join(" · ")}function lT({pointing:{at:i},facts:e}){if(!i||!e)return"";let[t,n]=i,{width:s,height:r}=e.texture;return`u ${t.toFixed(4)}, v ${n.toFixed(4)} · texel ${Math.floor(t*s)}, ${Math.floor((1-n)*r)}`}function cT({chart:i,group:e,atlases:t,marks:n,values:s},r,o){if(r==null)return o===null?"":`Chart ${o+1} is selected`;let a=t[e[r]],l=h=>h<3?vn(fa(In[h],s[4*r+h])):et(s[4*r+h]),c=`Face ${vt(r)}`;return!a?.isMapped||n[r]&by?`${c} · no UVs`:`${c} · chart ${i[r]+1} of ${a.charts} · stretch ${l(0)} · angle ${l(1)} · area ${l(2)} · ${l(3)} px/unit`}function hT({faces:i,charts:e,drawn:t,atlases:n},s){let r=[qt(i,"face")];return n.some(({isMapped:o})=>o)&&r.push(qt(e,"chart")),s&&t.count<t.of&&r.push(`simplified view: ${vt(t.count)} of ${vt(t.of)} faces are drawn, all are measured`),r.join(" · ")}function My(i,e){let{analysis:t,place:n,atlas:s}=i,r=t?.atlases[s],o=[];r&&n.shade==="heat"&&o.push(dT(n.measure,a=>e({measure:a})),pT(i),mT(i,e)),r&&n.shade==="checker"&&o.push(fT(n.cells,e)),$("legend").replaceChildren(...o),$("faults").replaceChildren(...r&&n.problems?uT(r):[])}function uT(i){let n=[[i.overlapping,"overlap","overlaps"],[i.flipped,"flipped face","flipped faces"],[i.near,"face near another island","faces near another island"],[i.isMapped?i.unmapped:0,"face without UVs","faces without UVs"]].filter(([s])=>s).map(([s,r,o])=>qt(s,r,o)).join(", ");return n?[F("span",{className:"wrong",textContent:n,title:n})]:i.isMapped?[F("span",{className:"right",textContent:"No overlaps or flips"})]:[]}function dT(i,e){let t=F("select",{id:"measure",aria:{label:"Measure of the heat map"}},...In.map(n=>F("option",{value:n,textContent:Nf[n].name,title:Nf[n].help,selected:n===i})));return t.addEventListener("change",()=>e(t.value)),t}function fT(i,e){let t=F("select",{id:"cells",aria:{label:"Cells of the checkerboard"}},...kh.map(n=>F("option",{value:String(n),textContent:`${n} cells across`,selected:n===i})));return t.addEventListener("change",()=>e({cells:Number(t.value)})),t}function pT(i){let{measure:e}=i.place,t=i.analysis?.atlases[i.atlas]?.spreads[In.indexOf(e)];if(!t)return F("span",{textContent:"No UVs to measure"});let[n,s]=i.range(),r=F("span",{className:"bar",aria:{hidden:"true"}});r.style.background=e0(e);let o=e==="density",a=u=>o?et(u):`${Math.round(1e3*u)/10} %`,l=u=>o?et(u):vn(fa(e,u)),c=i.analysisBeside?.atlases[0]?.spreads[In.indexOf(e)],h=c?` · before: mean ${l(c.mean)} · max ${l(c.greatest)}`:"";return F("span",{className:"scale"},F("span",{className:"ends",textContent:a(n)}),r,F("span",{className:"ends",textContent:`${a(s)}${o?" px/unit":""}`}),F("span",{className:"numbers",title:Nf[e].help,textContent:`min ${l(t.least)} · mean ${l(t.mean)} · max ${l(t.greatest)}${h}`}))}function mT({place:{scale:i}},e){let t=i==="fitted";return Ge("Fit scale",()=>e({scale:t?"fixed":"fitted"}),{title:"Spread the colors over the stretch of this result alone",aria:{pressed:String(t)}})}var Sy="unwrapd-theme";function Ay(i){let e=localStorage.getItem(Sy);e&&(document.documentElement.dataset.theme=e);let t=()=>$("theme").textContent=wy()?"Light":"Dark";$("theme").addEventListener("click",()=>{let n=wy()?"light":"dark";document.documentElement.dataset.theme=n,localStorage.setItem(Sy,n),t(),i()}),t()}function wy(){let{theme:i}=document.documentElement.dataset;return i?i==="dark":matchMedia("(prefers-color-scheme: dark)").matches}function Ty(i){let e=gT(i);$("title").textContent=e||(i.subject.kind==="missing"?"Not found":"Loading …"),$("title-state").textContent=i.subject.kind==="job"&&i.place.uvs==="before"?"before":"",document.title=e?`${e} · unwrapd`:"unwrapd"}function gT({place:i,subject:e,inHand:t}){return i.tab==="pull"&&t?t.name:e.kind==="file"?e.file.name:e.kind==="job"?e.job.filename:""}function Ey(i){let e=(n,s,r,o={})=>({key:n,does:s,act:()=>i.does(r),...o}),t=[e("g","Grab the selected handles: they follow the pointer until you click","grab"),e("r","Rotate them","rotate"),e("s","Scale them","scale"),e("Enter","Leave them there","confirm",{inPane:!0}),e("Escape","Put them back; select nothing","cancel"),e("p","Pin what is below the pointer","pin"),e("l","Lock: stay when others are moved together","lock"),e("Tab","Next handle","next",{shift:!1,inPane:!0}),e("a","Select all handles","all"),e("x","Let go","let_go"),e("Delete","Let go","let_go"),e("z","Undo","undo",{ctrl:!0,shift:!1}),e("z","Redo","redo",{ctrl:!0,shift:!0}),e("f","Show everything","frame"),e("b","Bake: make a job of what is shown","bake"),{key:"?",does:"These keys",act:()=>bs(t)}];return t}function ya({at:i,to:e,radius:t,turn:n,axis:s}){return t===0?{at:i,to:e}:{center:i,radius:t,to:e,turn:n,...s?{axis:s}:{}}}function yT(i,e,t){if("center"in e){let{center:n,radius:s,to:r,turn:o=0,axis:a=null}=e;return{name:i,at:n,to:r,radius:s,turn:o,axis:a,isLocked:t}}return{name:i,at:"at"in e?e.at:e.to,to:e.to,radius:0,turn:0,axis:null,isLocked:t}}var hh=class{all=[];selected=new Set;#e=0;add(e,t,n){let s={name:this.#e++,at:e,to:t,radius:n,turn:0,axis:null,isLocked:!1};return this.all.push(s),this.select(s.name),s}restore(e){this.all=e.map(t=>({...t})),this.#e=Math.max(0,...e.map(({name:t})=>t+1))}drop(e){this.all=this.all.filter(t=>t.name!==e),this.selected.delete(e)}take(e){let t=new Set(this.all.filter(({isLocked:n})=>n).map(({name:n})=>n));this.all=e.map(({name:n,handle:s})=>yT(n,s,t.has(n)));for(let n of[...this.selected])this.all.some(s=>s.name===n)||this.selected.delete(n);this.#e=Math.max(this.#e,...this.all.map(({name:n})=>n+1))}select(e,t=!1){t||this.selected.clear(),e!==null&&this.selected.add(e)}selectNext(){let e=this.all.findIndex(({name:n})=>this.selected.has(n)),t=this.all[(e+1)%this.all.length];t&&this.select(t.name)}lock(){for(let e of this.chosen(!0))e.isLocked=!e.isLocked}chosen(e=!1){return this.all.filter(({name:t,isLocked:n})=>this.selected.has(t)&&(e||!n))}},ga=class{constructor(e,t){this.gesture=e;this.#e=t.map(s=>({...s}));let[n]=t;this.pivot=(n?.to??[]).map((s,r)=>t.reduce((o,{to:a})=>o+a[r],0)/t.length)}gesture;#e;pivot;get names(){return this.#e.map(({name:e})=>e)}shifted(e){return this.#e.map(t=>({...t,to:t.to.map((n,s)=>n+e[s])}))}turned(e,t){return this.#e.map(n=>({...n,to:vT(n.to,this.pivot,e,t),turn:(xT(n.axis,t)?n.turn:0)+e,axis:n.radius?t:null}))}scaled(e){return this.#e.map(t=>({...t,to:t.to.map((n,s)=>this.pivot[s]+e*(n-this.pivot[s]))}))}};function xT(i,e){return i===e||i!==null&&e!==null&&i.every((t,n)=>Math.abs(t-e[n])<1e-6)}function vT(i,e,t,n){let s=t*Math.PI/180,[r,o]=[Math.sin(s),Math.cos(s)],a=i.map((h,u)=>h-e[u]);if(!n)return[e[0]+o*a[0]-r*a[1],e[1]+r*a[0]+o*a[1]];let l=n.reduce((h,u,d)=>h+u*a[d],0)*(1-o),c=[0,1,2].map(h=>n[(h+1)%3]*a[(h+2)%3]-n[(h+2)%3]*a[(h+1)%3]);return[0,1,2].map(h=>e[h]+o*a[h]+r*c[h]+l*n[h])}var _T=12,bT=3,dh=class{constructor(e,t,n){this.scene=e;this.grips=t;this.doer=n;for(let s of[e.places.plane,e.places.solid])s.addEventListener("pointerdown",r=>this.#r(r,s),{capture:!0}),s.addEventListener("pointermove",r=>this.#l(r,s),{capture:!0}),s.addEventListener("pointerup",r=>this.#h(r),{capture:!0})}scene;grips;doer;#e=null;#t=[0,0];#i=[0,0];#n=!1;#s=!1;get gesture(){return this.#e?.gesture??null}get touched(){return this.scene.touch(this.#i)}start(e){let t=this.grips.chosen();t.length&&(this.doer.begin(),[this.#e,this.#t,this.#s]=[new ga(e,t),this.#i,!1],this.doer.refresh())}end(e){this.#e&&(this.#e=null,e||this.doer.cancel(),this.doer.refresh())}#a([e,t]){let n=({to:r})=>{let[o,a]=this.scene.project(r);return Math.hypot(o-e,a-t)};return this.grips.all.map(r=>({grip:r,far:n(r)})).filter(({far:r})=>r<=_T).sort((r,o)=>r.far-o.far)[0]?.grip??null}#r(e,t){if(e.button!==0||t!==this.scene.pane)return;if(this.#i=Ry(t,e),this.#e)return uh(e),this.end(!0);let n=this.#a(this.#i),s=n?null:this.scene.touch(this.#i);if(!n&&!s)return this.#o();uh(e),t.focus(),t.setPointerCapture(e.pointerId),this.doer.begin();let r=n??this.doer.hold(s);e.shiftKey?this.grips.select(r.name,!0):this.grips.selected.has(r.name)||this.grips.select(r.name);let o=this.grips.chosen();o.length&&([this.#e,this.#t,this.#s,this.#n]=[new ga("grab",o),this.#i,!0,!1]),this.doer.refresh()}#o(){this.grips.select(null),this.doer.refresh()}#l(e,t){if(t!==this.scene.pane)return;if(this.#i=Ry(t,e),!this.#e){t.style.cursor=this.#a(this.#i)?"grab":"";return}this.#s&&uh(e);let n=Math.hypot(this.#i[0]-this.#t[0],this.#i[1]-this.#t[1]);!this.#n&&this.#s&&n<bT||(this.#n=!0,this.doer.moved(this.#c(this.#e),this.#e.gesture==="rotate"))}#c(e){let{scene:t}=this,[n,s]=[this.#t,this.#i].map(o=>t.placeAt(o,e.pivot));if(e.gesture==="grab")return e.shifted(s.map((o,a)=>o-n[a]));let r=t.project(e.pivot);return e.gesture==="scale"?e.scaled(Cc(r,this.#t,this.#i)):e.turned(Rc(r,this.#t,this.#i)*t.handedness,t.axis)}#h(e){!this.#e||!this.#s||(uh(e),this.end(!0))}};function Ry(i,e){let{left:t,top:n}=i.getBoundingClientRect();return[e.clientX-t,e.clientY-n]}function uh(i){i.stopImmediatePropagation(),i.preventDefault()}var Cy=()=>matchMedia("(prefers-reduced-motion: reduce)").matches,Py=Cy;function fh(i,e=380){if(Cy())return i(1);let t=performance.now(),n=s=>{let r=Math.min(Math.max((s-t)/e,0),1);i(r<1?r*r*(3-2*r):1),r<1&&requestAnimationFrame(n)};requestAnimationFrame(n)}var MT=.0016,Qr=class{camera=new Gi;scene=new Sn;#e;#t=[.5,.5];#i=.55;#n=[1,1];isMoved=!1;#s=new Map;#a;constructor(e,t){this.#a=e,this.#e=t;for(let n of e)this.#r(n)}get element(){return this.#a[0]}#r(e){e.style.touchAction="none",e.addEventListener("wheel",t=>this.#h(t,e),{passive:!1}),e.addEventListener("contextmenu",t=>t.preventDefault()),e.addEventListener("pointerdown",t=>{e.setPointerCapture(t.pointerId),this.#s.set(t.pointerId,[t.clientX,t.clientY])}),e.addEventListener("pointermove",t=>this.#d(t,e));for(let t of["pointerup","pointercancel"])e.addEventListener(t,n=>this.#s.delete(n.pointerId))}show(e){this.scene.children=[];for(let t of e)this.scene.add(t)}frame([e,t,n,s]){this.place=[(e+n)/2,(t+s)/2,Math.max(this.#o(n-e,s-t),1e-6)],this.isMoved=!1}#o(e,t){let[n,s]=this.#n,r=Math.min(n,s);return .54*Math.max(e*r/n,t*r/s)}flyTo(e,t,n){let s=this.place,r=[e,t,Math.min(Math.max(n*6,.06),.55)];fh(o=>this.place=s.map((a,l)=>a+(r[l]-a)*o))}get place(){return[...this.#t,this.#i]}set place([e=.5,t=.5,n=.55]){this.#t=[e,t],this.#i=n,this.isMoved=!0,this.#l()}resize(e,t){this.#n=[Math.max(e,1),Math.max(t,1)],this.#l()}#l(){let[e,t]=this.#n,n=this.#i/Math.min(e,t);Object.assign(this.camera,{left:-e*n,right:e*n,top:t*n,bottom:-t*n,near:-1,far:1}),this.camera.position.set(this.#t[0],this.#t[1],0),this.camera.updateProjectionMatrix(),this.#e()}at(e,t){let n=this.element.getBoundingClientRect();return[this.#t[0]+(e-n.left-n.width/2)*this.#c,this.#t[1]-(t-n.top-n.height/2)*this.#c]}get#c(){return 2*this.#i/Math.min(...this.#n)}#h(e,t){e.preventDefault(),this.#u(Math.exp(e.deltaY*MT*(e.deltaMode?24:1)),[e.clientX,e.clientY],t)}#u(e,[t,n],s){let r=s.getBoundingClientRect(),[o,a]=[t-r.left-r.width/2,n-r.top-r.height/2],l=Math.min(Math.max(this.#i*e,1e-4),20),c=this.#c*(1-l/this.#i);this.place=[this.#t[0]+o*c,this.#t[1]-a*c,l]}#d(e,t){let n=this.#s.get(e.pointerId);if(!n)return;let s=[...this.#s].filter(([u])=>u!==e.pointerId).map(([,u])=>u);this.#s.set(e.pointerId,[e.clientX,e.clientY]);let r=1/(s.length+1),[o,a]=[(e.clientX-n[0])*r,(e.clientY-n[1])*r];this.place=[this.#t[0]-o*this.#c,this.#t[1]+a*this.#c,this.#i];let l=s[0];if(!l)return;let c=Math.hypot(n[0]-l[0],n[1]-l[1]),h=Math.hypot(e.clientX-l[0],e.clientY-l[1]);0<c&&0<h&&this.#u(c/h,[(e.clientX+l[0])/2,(e.clientY+l[1])/2],t)}};var Iy={type:"change"},Of={type:"start"},Ny={type:"end"},ph=new yi,Ly=new Un,ST=Math.cos(70*Wr.DEG2RAD),Vt=new U,Ln=2*Math.PI,at={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Uf=1e-6,mh=class extends Vo{constructor(e,t=null){super(e,t),this.state=at.NONE,this.target=new U,this.cursor=new U,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:ms.ROTATE,MIDDLE:ms.DOLLY,RIGHT:ms.PAN},this.touches={ONE:gs.ROTATE,TWO:gs.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new U,this._lastQuaternion=new sn,this._lastTargetPosition=new U,this._quat=new sn().setFromUnitVectors(e.up,new U(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Or,this._sphericalDelta=new Or,this._scale=1,this._panOffset=new U,this._rotateStart=new Ee,this._rotateEnd=new Ee,this._rotateDelta=new Ee,this._panStart=new Ee,this._panEnd=new Ee,this._panDelta=new Ee,this._dollyStart=new Ee,this._dollyEnd=new Ee,this._dollyDelta=new Ee,this._dollyDirection=new U,this._mouse=new Ee,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=AT.bind(this),this._onPointerDown=wT.bind(this),this._onPointerUp=TT.bind(this),this._onContextMenu=NT.bind(this),this._onMouseWheel=CT.bind(this),this._onKeyDown=PT.bind(this),this._onTouchStart=IT.bind(this),this._onTouchMove=LT.bind(this),this._onMouseDown=ET.bind(this),this._onMouseMove=RT.bind(this),this._interceptControlDown=DT.bind(this),this._interceptControlUp=UT.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=at.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Iy),this.update(),this.state=at.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;Vt.copy(t).sub(this.target),Vt.applyQuaternion(this._quat),this._spherical.setFromVector3(Vt),this.autoRotate&&this.state===at.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=Ln:n>Math.PI&&(n-=Ln),s<-Math.PI?s+=Ln:s>Math.PI&&(s-=Ln),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Vt.setFromSpherical(this._spherical),Vt.applyQuaternion(this._quatInverse),t.copy(this.target).add(Vt),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Vt.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new U(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new U(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Vt.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(ph.origin.copy(this.object.position),ph.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(ph.direction))<ST?this.object.lookAt(this.target):(Ly.setFromNormalAndCoplanarPoint(this.object.up,this.target),ph.intersectPlane(Ly,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Uf||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Uf||this._lastTargetPosition.distanceToSquared(this.target)>Uf?(this.dispatchEvent(Iy),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?Ln/60*this.autoRotateSpeed*e:Ln/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){Vt.setFromMatrixColumn(t,0),Vt.multiplyScalar(-e),this._panOffset.add(Vt)}_panUp(e,t){this.screenSpacePanning===!0?Vt.setFromMatrixColumn(t,1):(Vt.setFromMatrixColumn(t,0),Vt.crossVectors(this.object.up,Vt)),Vt.multiplyScalar(e),this._panOffset.add(Vt)}_pan(e,t){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Vt.copy(s).sub(this.target);let r=Vt.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/n.clientHeight,this.object.matrix),this._panUp(2*t*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=e-n.left,r=t-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(Ln*this._rotateDelta.x/t.clientHeight),this._rotateUp(Ln*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(Ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-Ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(Ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-Ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(n,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),n=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let n=this._getSecondPointerPosition(e),s=.5*(e.pageX+n.x),r=.5*(e.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(Ln*this._rotateDelta.x/t.clientHeight),this._rotateUp(Ln*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),n=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),n=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new Ee,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,n={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function wT(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function AT(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function TT(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Ny),this.state=at.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function ET(i){let e;switch(i.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case ms.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=at.DOLLY;break;case ms.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=at.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=at.ROTATE}break;case ms.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=at.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=at.PAN}break;default:this.state=at.NONE}this.state!==at.NONE&&this.dispatchEvent(Of)}function RT(i){switch(this.state){case at.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case at.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case at.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function CT(i){this.enabled===!1||this.enableZoom===!1||this.state!==at.NONE||(i.preventDefault(),this.dispatchEvent(Of),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(Ny))}function PT(i){this.enabled!==!1&&this._handleKeyDown(i)}function IT(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case gs.ROTATE:if(this.enableRotate===!1){this.state=at.NONE;break}this._handleTouchStartRotate(i),this.state=at.TOUCH_ROTATE;break;case gs.PAN:if(this.enablePan===!1){this.state=at.NONE;break}this._handleTouchStartPan(i),this.state=at.TOUCH_PAN;break;default:this.state=at.NONE}break;case 2:switch(this.touches.TWO){case gs.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=at.TOUCH_DOLLY_PAN;break;case gs.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=at.TOUCH_DOLLY_ROTATE;break;default:this.state=at.NONE}break;default:this.state=at.NONE}this.state!==at.NONE&&this.dispatchEvent(Of)}function LT(i){switch(this._trackPointer(i),this.state){case at.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case at.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case at.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case at.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=at.NONE}}function NT(i){this.enabled!==!1&&i.preventDefault()}function DT(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function UT(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var OT=[.55,.35,1],Dy=1.4,FT=6e4/Dy,eo=class{camera=new Ut(32,1,.01,100);scene=new Sn;#e;#t=new It(new U,1);#i=0;isMoved=!1;constructor(e,t){let n=e.map(s=>new mh(this.camera,s));this.#e=n[0],this.#e.autoRotateSpeed=Dy;for(let s of n)s.zoomToCursor=!0,s.addEventListener("change",()=>{for(let r of n)r.target.copy(s.target);t()}),s.addEventListener("start",()=>{this.turn(!1),this.isMoved=!0,s.target.copy(this.#e.target)})}show(e,t){this.scene.children=[];for(let n of e)this.scene.add(n);t&&(this.#t=t.clone())}frame(e=OT){let{center:t,radius:n}=this.#t,s=this.camera.fov*Math.PI/360,r=Math.min(s,Math.atan(Math.tan(s)*this.camera.aspect)),o=n/Math.sin(r);this.isMoved=!1,this.#n(t.clone().add(new U(...e).normalize().multiplyScalar(o)),t)}flyTo(e,t,n){this.turn(!1),this.isMoved=!0;let s=Math.max(n*9,this.#t.radius*.55),[r,o]=[this.camera.position.clone(),this.#e.target.clone()],a=e.clone().add(t.clone().normalize().multiplyScalar(s));fh(l=>this.#n(r.clone().lerp(a,l),o.clone().lerp(e,l)))}turn(e){this.#e.autoRotate=e&&!Py(),clearTimeout(this.#i),this.#e.autoRotate&&(this.#i=window.setTimeout(()=>this.turn(!1),FT))}get isTurning(){return this.#e.autoRotate}update(){return this.#e.update()||this.#e.autoRotate}resize(e,t){this.camera.aspect=e/Math.max(t,1),this.camera.updateProjectionMatrix()}get place(){return[...this.camera.position.toArray(),...this.#e.target.toArray()]}set place(e){this.isMoved=!0,this.#n(new U().fromArray(e),new U().fromArray(e,3))}#n(e,t){this.camera.position.copy(e),this.#e.target.copy(t),this.camera.near=this.#t.radius/500,this.camera.far=this.#t.radius*100,this.camera.updateProjectionMatrix(),this.#e.update()}};function bn(i){let e=document.documentElement,t=e.style.outlineColor;e.style.outlineColor=`var(${i})`;let{outlineColor:n}=getComputedStyle(e);return e.style.outlineColor=t,n}var Ff=8,xa=class{#e="";#t=[];of(e,t,n,s){let r=[e,t,...Object.values(n),s?.uuid].join();if(r===this.#e)return this.#t;for(let{geometry:o,material:a}of this.#t){o.dispose();for(let l of[a].flat())l.dispose()}return this.#e=r,this.#t=[...Bf(e,t,n),...s?[BT(s,t)]:[]],this.#t}};function Bf(i,e,t){let n=[],s=[];for(let o=0;o<i;o++)for(let a=0;a<=Ff;a++){let l=a%Ff===0?s:n,c=a/Ff;l.push(o*e,c,0,(o+1)*e,c,0),l.push((o+c)*e,0,0,(o+c)*e,1,0)}let r=new je(new fs(i*e,1),kT(t.paper));return r.position.set(i*e/2,.5,0),[gh(r,-3),gh(Uy(n,t.line),-2),gh(Uy(s,t.border),-1)]}function kf(i){return Number.isFinite(i[2])?Math.min(Math.max(Math.ceil(i[2]-1e-4),1),10):1}function BT(i,e){let t=new fs(e,1);if(!i.flipY){let s=t.getAttribute("uv");for(let r=0;r<s.count;r++)s.setY(r,1-s.getY(r))}let n=new je(t,new rn({map:i,depthTest:!1,depthWrite:!1,toneMapped:!1}));return n.position.set(e/2,.5,0),gh(n,-2)}function kT(i){return new rn({color:i,depthTest:!1,depthWrite:!1,toneMapped:!1})}function Uy(i,e){let t=new Je;return t.setAttribute("position",new ze(Float32Array.from(i),3)),new Bn(t,new yn({color:e,depthTest:!1,depthWrite:!1,toneMapped:!1}))}function gh(i,e){return i.renderOrder=e,i}function yh(i,e){let t=VT(i),n=HT(i),{values:s,ids:r}=GT(i);e.uValues.value=s,e.uIds.value=r;let o=l=>({surface:va(t,_a(e,l,kc,of)),overlay:va(t,zT(_a(e,l,kc,of,"OVERLAY"))),borders:va(n,_a(e,l,af,lf)),pickSurface:va(t,_a(e,l,kc,n0)),pickBorders:va(n,_a(e,l,af,lf,"PICK"))}),a={solid:o("solid"),plane:o("plane")};return a.plane.borders.renderOrder=a.solid.borders.renderOrder=2,{layers:a,bytes:Oy(t)+Oy(n)+[s,r].reduce((l,c)=>l+c.image.data.byteLength,0),dispose(){for(let{geometry:l,material:c}of Object.values(a).flatMap(h=>Object.values(h)))l.dispose(),c.dispose();s.dispose(),r.dispose()}}}function va(i,e){let t=new je(i,e);return t.frustumCulled=!1,t}function _a(i,e,t,n,s=""){return new An({glslVersion:Ks,vertexShader:t,fragmentShader:n,uniforms:{...i,uThick:{value:s==="PICK"?10:0}},defines:{...e==="plane"?{PLANE:1}:{},...s?{[s]:1}:{}},side:Lt,blending:ci})}function zT(i){return Object.assign(i,{transparent:!0,blending:ys,depthWrite:!1,polygonOffset:!0,polygonOffsetFactor:-1,polygonOffsetUnits:-4}),i}function VT({drawn:i}){let e=new Je;return e.setAttribute("position",new ze(i.positions,3)),e.setAttribute("normal",new Fs(i.normals,4,!0)),e.setAttribute("faceUv",new ze(i.uvs,2)),e.computeBoundingSphere(),e}function HT({borders:i,chart:e,group:t}){let n=new Bo;n.setAttribute("position",new ze(Float32Array.of(0,-1,0,1,-1,0,1,1,0,0,1,0),3)),n.setIndex([0,1,2,0,2,3]);let s=i.face.length,r=new Float32Array(3*s),o=new Float32Array(3*s),a=new Uint32Array(4*s);for(let c=0;c<s;c++){r.set(i.ends.subarray(6*c,6*c+3),3*c),o.set(i.ends.subarray(6*c+3,6*c+6),3*c);let h=i.face[c];a.set([e[h],t[h]|i.marks[c]<<16,i.seam[c],c],4*c)}n.setAttribute("from",new wn(r,3)),n.setAttribute("to",new wn(o,3)),n.setAttribute("planeEnds",new wn(i.uvs,4));let l=new wn(a,4);return l.gpuType=Cn,n.setAttribute("facts",l),n.instanceCount=s,n}function GT({drawn:i,values:e,chart:t,group:n,marks:s}){let r=Math.max(1,Math.ceil(i.count/Pn)),o=new Float32Array(4*Pn*r),a=new Uint32Array(4*Pn*r);i.face.forEach((h,u)=>{o.set(e.subarray(4*h,4*h+4),4*u),a[4*u]=h,a[4*u+1]=t[h],a[4*u+2]=n[h]|s[h]<<16});let l=new Fn(o,Pn,r,an,Jt),c=new Fn(a,Pn,r,Vr,Cn);return c.internalFormat="RGBA32UI",l.needsUpdate=c.needsUpdate=!0,{values:l,ids:c}}function Oy(i){return Object.values(i.attributes).reduce((e,t)=>e+t.array.byteLength,0)}var WT=1e-5,xh=class i{uniforms=pa();#e;#t;#i;#n;#s;constructor({analysis:e,texture:t,picture:n},s){let{drawn:r}=e,o=r.uvs.slice(),a=Uint16Array.from(r.face,l=>e.group[l]);this.#t={count:r.count,positions:r.positions,uvs:o,mesh:new Uint32Array(r.count),group:a},this.#i=s,this.#s=t,this.#n=n&&qT(n),this.#e=yh({...e,drawn:{...r,uvs:o}},this.uniforms),this.uniforms.uProblems.value=0,this.uniforms.uChecker.value.set(32,32*t.height/t.width),this.#n&&(this.uniforms.uImage.value=this.#n)}static of(e,t){let n=e&&XT(e);if(!n)return null;let{drawn:s}=e.analysis;return s.uvs.every((o,a)=>Number.isNaN(o)||Math.abs(o-t[6*n[Math.floor(a/6)]+a%6])<WT)?new i(e,n):null}get things(){let{surface:e,borders:t}=this.#e.layers.solid;return[e,t]}get sphere(){return this.#e.layers.solid.surface.geometry.boundingSphere}get hasPicture(){return this.#n!==null}fill(e){this.uniforms.uShade.value=Ti.indexOf(e==="material"?"image":e)}move(e){let t=this.#t.uvs;this.#i.forEach((n,s)=>{Number.isNaN(t[6*s])||t.set(e.subarray(6*n,6*n+6),6*s)}),this.#e.layers.solid.surface.geometry.attributes.faceUv.needsUpdate=!0,this.uniforms.uShade.value===Ti.indexOf("heat")&&this.#a()}#a(){let e=this.uniforms.uValues.value;e.image.data.set(wf(this.#t,this.#s).values),e.needsUpdate=!0}dispose(){this.#e.dispose(),this.#n?.dispose()}};function XT({analysis:i,origins:e}){let{drawn:t}=i;if(t.count!==t.of)return null;let n=new Uint8Array(i.faces);t.face.forEach((o,a)=>n[o]=+!Number.isNaN(t.uvs[6*a]));let s=new Uint32Array(i.faces),r=0;for(let{begin:o,count:a}of e.toSorted((l,c)=>l.mesh-c.mesh||l.primitive-c.primitive))if(n.subarray(o,o+a).some(Boolean))for(let l=o;l<o+a;l++)s[l]=r++;return t.face.map(o=>s[o])}function qT(i){let e=i.image,t=new OffscreenCanvas(e.width,e.height);t.getContext("2d").drawImage(e,0,0);let n=new Co(t);return n.wrapS=n.wrapT=$n,n.colorSpace="",n}var zf=1e-6,vh=class{constructor(e,t){this.triangles=e;this.#e=e.length/3,this.#t={borders:$T(e),ofFace:YT(e)},this.#i=t.reduce((n,s,r)=>r%2?n:Math.max(n,Math.ceil(s-zf)),1)}triangles;#e;#t;#i;judge(e,t){let n=new Set,s=Uint32Array.from({length:this.#e},(h,u)=>u),r=If({uvs:e},s,(h,u)=>n.add(h).add(u)),o=s.filter(h=>this.#n(e,h));for(let h of o)n.add(h);let a=new Uint16Array(this.#e),l=t?cf({uvs:e,group:a},this.#t,t):new Uint8Array,c=[...this.#t.borders].filter((h,u)=>l[u]);return{faults:{pairs:r,beyond:o.length,near:c.length},marked:{faces:n,borders:c}}}#n(e,t){return e.subarray(6*t,6*t+6).some((n,s)=>n<-zf||(s%2?1:this.#i)+zf<n)}};function $T(i){let e=new Map,t=new Set;for(let n=0;n<i.length;n++){let[s,r]=[i[n],i[n%3===2?n-2:n+1]],o=Math.min(s,r)*67108864+Math.max(s,r),a=e.get(o);a===void 0?t.add(n):t.delete(a),e.set(o,a??n)}return Uint32Array.from(t)}function YT(i){let e=Uint32Array.from({length:i.reduce((n,s)=>Math.max(n,s+1),0)},(n,s)=>s),t=n=>{for(;e[n]!==n;)n=e[n]=e[e[n]];return n};for(let n=0;n<i.length;n+=3){let s=t(i[n]);e[t(i[n+1])]=s,e[t(i[n+2])]=s}return Uint32Array.from({length:i.length/3},(n,s)=>t(i[3*s]))}var _h=class{constructor(e,t){this.mesh=e;this.down=t;this.#e=this.#i(e.rest),this.#t=this.#e,this.attribute=new ze(new Float32Array(3*this.#e.length/e.dim),3),this.attribute.setUsage(Ku),this.move(e.rest)}mesh;down;attribute;#e;#t;#i(e){let{dim:t,skin:n,weights:s}=this.mesh;if(!n.length)return Float64Array.from(e);let r=new Float64Array(t*n.length/4);for(let o=0;o<n.length;o++)for(let a=0;a<t;a++)r[t*(o>>2)+a]+=s[o]*e[t*n[o]+a];return r}move(e){this.#t=this.#i(e);let{dim:t}=this.mesh,{array:n,count:s}=this.attribute;for(let r=0;r<s;r++)n[3*r]=this.#t[t*r],n[3*r+1]=this.#n(this.#t[t*r+1]),t===3&&(n[3*r+2]=this.#t[t*r+2]);this.attribute.needsUpdate=!0}uvs(){let{array:e}=this.attribute;return Float32Array.from({length:2*this.mesh.triangles.length},(t,n)=>e[3*this.mesh.triangles[n>>1]+(n&1)])}#n(e){return this.down===null?e:this.down-e}outward([e,t,n=0]){return new U(e,this.#n(t),n)}inward({x:e,y:t,z:n}){return this.mesh.dim===2?[e,this.#n(t)]:[e,t,n]}box(){let{array:e}=this.attribute,t=[1/0,1/0,-1/0,-1/0];for(let n=0;n<e.length;n+=3)t[0]=Math.min(t[0],e[n]),t[1]=Math.min(t[1],e[n+1]),t[2]=Math.max(t[2],e[n]),t[3]=Math.max(t[3],e[n+1]);return t}get extent(){let{dim:e}=this.mesh,t=Array.from({length:e},(n,s)=>{let[r,o]=[1/0,-1/0];for(let a=s;a<this.#e.length;a+=e)[r,o]=[Math.min(r,this.#e[a]),Math.max(o,this.#e[a])];return o-r});return Math.max(...t)}#s(e,t,n){let{dim:s,triangles:r}=this.mesh,o=r[3*t+n];return[...e.subarray(s*o,s*(o+1))]}touchPlane(e){for(let t=0;t<this.mesh.triangles.length/3;t++){let n=this.#a(t,e);if(n&&n.every(s=>0<=s))return this.#r(t,n)}return null}touchFace(e,t){let[n,s,r]=[0,1,2].map(c=>new U(...this.#s(this.#t,e,c))),o=(c,h,u)=>h.clone().sub(c).cross(u.clone().sub(c)),a=o(n,s,r),l=c=>c.dot(a)/a.lengthSq();return this.#r(e,[l(o(t,s,r)),l(o(t,r,n)),l(o(t,n,s))])}#a(e,[t,n]){let[s,r,o]=[0,1,2].map(h=>this.#s(this.#t,e,h)),a=(h,u)=>(h[0]-t)*(u[1]-n)-(h[1]-n)*(u[0]-t),l=[a(r,o),a(o,s),a(s,r)],c=l.reduce((h,u)=>h+u,0);return c===0?null:l.map(h=>h/c)}#r(e,t){let n=s=>{let r=t.map((o,a)=>this.#s(s,e,a));return r[0].map((o,a)=>t.reduce((l,c,h)=>l+c*r[h][a],0))};return{at:n(this.#e),to:n(this.#t)}}};var KT=6e4,bh=class{constructor(e,t){this.places=t;this.#e=new $r({canvas:e,antialias:!0}),this.#t=new Qr([t.plane],()=>this.redraw()),this.#i=new eo([t.solid],()=>this.redraw()),new ResizeObserver(()=>this.#x()).observe(e.parentElement)}places;#e;#t;#i;#n=null;#s={down:null,picture:null,isMap:!1,shown:null};#a=null;beside=null;#r=null;#o=[];#l=new Je;#c=new Je;#h=!1;step=0;drawn=()=>{};get isPlanar(){return this.#n?.mesh.dim!==3}get pane(){return this.isPlanar?this.places.plane:this.places.solid}async show(e,t){this.clear(),this.#s=t,this.#n=new _h(e,t.down),t.isMap&&(this.#a=new vh(e.triangles,this.#n.uvs())),t.isMap&&(this.beside=xh.of(t.shown,this.#n.uvs())),this.places.plane.hidden=e.dim===3,this.places.solid.hidden=e.dim===2&&!this.beside,this.places.solid.setAttribute("aria-label",this.beside?"Surface of the UVs: drag to turn, wheel to zoom":this.places.plane.getAttribute("aria-label")),this.places.plane.parentElement.classList.toggle("beside",this.beside!==null);let n=t.picture?await JT(t.picture):null,s=new Je;s.setAttribute("position",this.#n.attribute),s.setIndex(new ze(e.triangles,1)),n&&s.setAttribute("uv",new ze(jT(e),2)),this.#r=new je(s,this.#u(n)),this.#r.frustumCulled=!1,this.#o=[...t.isMap?Bf(1,1,{paper:bn("--sheet"),line:bn("--sheet-line"),border:bn("--sheet-border")}):[],this.#r],!n&&e.triangles.length<=3*KT&&this.#o.push(this.#p(e));let r=new Wi(16777215,2);r.position.set(1,2,3),t.isMap&&this.#o.push(this.#f(),this.#d());let o=[new Gs(16777215,9080728,2),r];s.computeBoundingSphere(),e.dim===3?this.#i.show([...this.#o,...o],s.boundingSphere):this.#t.show(this.#o),this.beside&&this.#i.show(this.beside.things,this.beside.sphere),this.#x(),this.frame()}#u(e){let t={polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1,side:Lt};return this.isPlanar?new rn({...e?{map:e}:{color:bn("--pulled")},depthTest:!1,depthWrite:!1,toneMapped:!1,side:Lt}):new Tn({color:bn("--pulled"),flatShading:!0,roughness:.8,...t})}#d(){this.#c.setAttribute("position",this.#n.attribute),this.#c.setIndex([]);let e=new Bn(this.#c,new yn({color:bn("--alarm"),depthTest:!1,toneMapped:!1}));return e.frustumCulled=!1,e.renderOrder=2,e}#f(){this.#l.setAttribute("position",this.#n.attribute),this.#l.setIndex([]);let e=new je(this.#l,new rn({color:bn("--alarm"),transparent:!0,opacity:.75,depthTest:!1,depthWrite:!1,toneMapped:!1,side:Lt}));return e.frustumCulled=!1,e}#p(e){let t=new Je;t.setAttribute("position",this.#n.attribute),t.setIndex(new ze(ZT(e.triangles),1));let n=new Bn(t,new yn({color:bn("--pulled-wire"),transparent:!0,opacity:.55,depthTest:e.dim===3,toneMapped:!1}));return n.frustumCulled=!1,n.renderOrder=1,n}move(e){this.#n?.move(e),this.beside&&this.beside.move(this.#n.uvs()),this.step+=1,this.redraw()}refill(){this.beside?.move(this.#n.uvs()),this.redraw()}get isMap(){return this.#s.isMap&&this.#n!==null}faults(){let{triangles:e}=this.#n.mesh,{faults:t,marked:n}=this.#a.judge(this.#n.uvs(),this.#g);return this.#l.setIndex([...n.faces].flatMap(s=>[...e.subarray(3*s,3*s+3)])),this.#c.setIndex(n.borders.flatMap(s=>[e[s],e[s%3===2?s-2:s+1]])),this.redraw(),t}get#g(){return this.beside?this.#s.shown.texture:null}clear(){for(let e of this.#o){e.geometry.dispose();for(let t of[e.material].flat())t.dispose()}this.#o=[],this.#r=this.#n=this.#a=null,this.beside?.dispose(),this.beside=null,this.#t.show([]),this.#i.show([],null),this.redraw()}frame(){if(!this.#n||((!this.isPlanar||this.beside)&&this.#i.frame(),!this.isPlanar))return;let[e,t,n,s]=this.#s.isMap?[0,0,1,1]:this.#n.box(),[r,o]=[.15*(n-e),.15*(s-t)];this.#t.frame([e-r,t-o,n+r,s+o])}redraw(){this.#h||(this.#h=!0,requestAnimationFrame(()=>{this.#h=!1,this.#m()}))}#m(){let e=!this.isPlanar||this.beside!==null;e&&this.#i.update()&&this.redraw(),this.#e.setClearColor(new be(bn("--stage")),1),this.#e.setScissorTest(!1),this.#e.clear(),this.#n&&this.isPlanar&&this.#_(this.places.plane,this.#t),this.#n&&e&&this.#_(this.places.solid,this.#i),this.drawn()}#_(e,{scene:t,camera:n}){let s=this.#e.domElement.getBoundingClientRect(),{left:r,bottom:o,width:a,height:l}=e.getBoundingClientRect();if(a<1||l<1)return;let c=[r-s.left,s.bottom-o,a,l],h=this.#e.getPixelRatio();this.beside?.uniforms.uViewport.value.set(a*h,l*h),this.beside&&(this.beside.uniforms.uPixelRatio.value=h),this.#e.setViewport(...c),this.#e.setScissor(...c),this.#e.setScissorTest(!0),this.#e.render(t,n)}#x(){let{width:e,height:t}=this.#e.domElement.parentElement.getBoundingClientRect();if(!(e<1||t<1)){this.#e.setPixelRatio(Math.min(devicePixelRatio,2)),this.#e.setSize(e,t,!1);for(let[n,s]of[[this.#t,this.places.plane],[this.#i,this.places.solid]]){let r=s.getBoundingClientRect();n.resize(r.width,r.height)}this.redraw()}}get#y(){let{camera:e}=this.isPlanar?this.#t:this.#i;return e.updateMatrixWorld(),e}project(e){let{width:t,height:n}=this.pane.getBoundingClientRect(),{x:s,y:r}=this.#n.outward(e).project(this.#y);return[(s+1)/2*t,(1-r)/2*n]}placeAt([e,t],n){let{z:s}=this.#n.outward(n).project(this.#y);return this.#n.inward(new U(...this.#v(e,t),s).unproject(this.#y))}touch([e,t]){if(!this.#r||!this.#n)return null;if(this.isPlanar)return this.#n.touchPlane(this.placeAt([e,t],[0,0]));let n=new zo;n.setFromCamera(new Ee(...this.#v(e,t)),this.#y),this.#r.geometry.computeBoundingSphere();let[s]=n.intersectObject(this.#r,!1);return s?.faceIndex===void 0||s.faceIndex===null?null:this.#n.touchFace(s.faceIndex,s.point)}get axis(){return this.isPlanar?null:new U(0,0,1).transformDirection(this.#y.matrixWorld).toArray()}get handedness(){return this.isPlanar&&this.#s.down!==null?-1:1}get extent(){return this.#n?.extent??1}#v(e,t){let{width:n,height:s}=this.pane.getBoundingClientRect();return[e/n*2-1,1-t/s*2]}};function jT({rest:i,picture:[e,t]}){return Float32Array.from(i,(n,s)=>s%2?1-n/t:n/e)}async function JT(i){let e=URL.createObjectURL(i),t=await new Hi().loadAsync(e).finally(()=>URL.revokeObjectURL(e));return t.colorSpace=dt,t}function ZT(i){let e=new Set,t=[];for(let n=0;n<i.length;n+=3)for(let[s,r]of[[0,1],[1,2],[2,0]]){let[o,a]=[i[n+s],i[n+r]],l=Math.min(o,a)*67108864+Math.max(o,a);e.has(l)||(e.add(l),t.push(o,a))}return Uint32Array.from(t)}function Fy(){let i=$("pull-pane"),e={plane:F("div",{className:"pane"}),solid:F("div",{className:"pane",hidden:!0})};for(let t of Object.values(e))t.tabIndex=0,t.setAttribute("role","application"),t.setAttribute("aria-label","What is pulled: press to hold, drag to pull"),i.insertBefore(t,$("pull-grips"));try{return new bh($("pull-canvas"),e)}catch{return null}}function By(i,e){$("pull-grips").replaceChildren(...e.all.map(t=>QT(i,t,e.selected.has(t.name))))}function QT(i,e,t){let[n,s]=i.project(e.to),r=["grip",t&&"selected",e.isLocked&&"locked"].filter(Boolean).join(" "),o=e.isLocked?jn("rect",{x:n-5,y:s-5,width:10,height:10,class:r}):jn("circle",{cx:n,cy:s,r:6,class:r});return o.append(jn("title",{},`Handle ${e.name+1}`)),o}var eE=[["Undo","Ctrl Z","undo"],["Redo","Ctrl Shift Z","redo"],["Reset","","reset"]],tE=[["Grab","G","grab"],["Rotate","R","rotate"],["Scale","S","scale"]],nE=[["Lock","L","lock"],["Let go","X","let_go"],["Next","Tab","next"]],iE=[["checker","Checker"],["heat","Heat map"],["material","Texture"]],sE=[["Press","hold"],["Drag","pull"],["P","pin"],["G R S","grab, rotate, scale"],["L","lock"],["Tab","next handle"],["X","let go"],["Ctrl Z","undo"]],Mh=class{#e=F("select",{id:"pull-way",aria:{label:"What to pull"}});#t;#i=F("input",{type:"range",id:"pull-size",min:"0",max:"0.3",step:"0.01",aria:{label:"Size of a handle"}});#n=F("select",{id:"pull-fill",aria:{label:"Fill of the surface"}});#s=F("strong",{id:"pull-name"});#a;#r;#o=$("pull-note");#l=[];constructor(e){let t=F("input",{type:"file",accept:Vg,multiple:!0,hidden:!0,id:"pull-files",aria:{label:"File to pull"}});t.addEventListener("change",()=>{e.take([...t.files??[]]),t.value=""}),this.#t=Ge("Take hold",()=>e.start(this.#e.selectedIndex),{id:"pull-start",className:"primary"}),this.#i.addEventListener("input",()=>e.resize(Number(this.#i.value))),this.#n.append(...iE.map(([r,o])=>F("option",{value:r,textContent:o}))),this.#n.addEventListener("change",()=>e.fill(this.#n.value));let n=([r,o,a])=>Ge(r,()=>e.does(a),{title:o?`${r} (${o})`:r,data:{does:a}}),s=(r,o)=>F("div",{className:"tools",aria:{role:"group",label:r}},...o.map(n));this.#a=[this.#e,this.#t,Ge("Choose a file",()=>t.click(),{id:"pull-choose"})],this.#r=[this.#s,s("Change",eE),s("Move",tE),s("Handles",nE),F("label",{className:"size",textContent:"Handle size "},this.#i),this.#n,Ge("Bake",()=>e.does("bake"),{id:"pull-bake",className:"primary",title:"Make a job of what is shown: written and certified (B)"}),Ge("End",()=>e.does("end"),{title:"End the session"})],$("pull-tools").append(...this.#a,...this.#r,t),$("pull-hints").append(...sE.flatMap(([r,o])=>[F("kbd",{textContent:r}),` ${o} `])),this.ended("")}offer(e,t,n){this.#e.replaceChildren(...t.map(({name:s,title:r})=>F("option",{textContent:s,title:r}))),this.#t.disabled=!t.length,this.say(e?`${e} can be pulled here: its shape follows your handles, live, and no element is ever inverted.${n?` ${qt(n,"handle")} of last time will be there.`:""}`:"Choose a mesh, a picture or a drawing to pull.")}started(e,t,n){this.#c(!0),this.#s.textContent=e,this.#s.title=t.title,this.#i.value=String(n),this.#i.parentElement.hidden=t.kind!=="deform",this.filled(null,!1),this.#l=[]}ended(e){this.#c(!1),this.say(e),this.judged({pairs:0,beyond:0,near:0}),$("pull-figures").textContent=""}#c(e){for(let t of this.#a)t.hidden=e;for(let t of this.#r)t.hidden=!e;$("pull-hints").hidden=!e}say(e){this.#o.textContent=e,this.#o.hidden=e===""}note(e){this.say(e),setTimeout(()=>this.#o.textContent===e&&this.say(""),4e3)}refresh(e,t){let n=e.chosen(!0).length>0;for(let s of $("pull-tools").querySelectorAll("[data-does]")){let{does:r}=s.dataset;s.disabled=["grab","rotate","scale"].includes(r)?!e.chosen().length:["lock","let_go"].includes(r)?!n:!1,s.setAttribute("aria-pressed",String(r===t))}}filled(e,t){this.#n.hidden=e===null,this.#n.value=e??"checker",this.#n.options[2].disabled=!t}judged({pairs:e,beyond:t,near:n}){let s=[e?qt(e,"overlap"):"",t?`${qt(t,"face")} beyond the page`:"",n?`${qt(n,"edge")} nearer than the padding`:""].filter(Boolean);$("pull-faults").textContent=s.join(" · ")}waited(e){this.#l=[...this.#l.slice(-60),e]}frame({stage:e,step:t,flips:n,energy:s,smallest:r}){let o=[...this.#l].sort((a,l)=>a-l)[this.#l.length>>1];$("pull-figures").textContent=[`${n} flips`,Number.isFinite(r)?`smallest element ${(100*r).toFixed(1)} % of rest`:"",Number.isFinite(s)?`energy ${et(s)}`:"",`iteration ${t}`,{moving:"moving",settled:"at rest",unreached:"targets cannot be reached"}[e],o===void 0?"":`follows in ${o.toFixed(0)} ms`].filter(Boolean).join(" · ")}};var rE={expired:"The session ended: nothing was pulled for a while.",stopping:"The service stops.",closed:"The session was ended."},oE=1e3,Sh=class{constructor(e,t){this.store=e;this.told=t;this.#e=Fy(),this.#t=this.#e&&new dh(this.#e,this.grips,this),this.#e&&(this.#e.drawn=()=>this.#S()),this.#i=new Mh({start:n=>{this.start(this.#s[n]??null)},take:n=>this.takeFiles(n),resize:n=>this.#g=n,does:n=>this.does(n),fill:n=>e.go({shade:n})}),e.show(()=>this.#b()),addEventListener("beforeunload",n=>{this.#r&&this.#d&&n.preventDefault()}),addEventListener("pagehide",()=>{this.#v()})}store;told;grips=new hh;#e;#t;#i;#n=null;#s=[];#a=null;#r=null;#o=null;#l=Promise.resolve();#c=null;#h=0;#u=-1;#d=!1;#f=0;#p=!1;#g=0;get isActive(){return this.#r!==null}offer(e,t){if(this.#r||this.#p)return;if(this.#n=e,!this.#e)return this.#i.offer(null,[],0),this.#i.say("Pulling needs WebGL, which this browser does not show here.");this.#s=e?Hg(e.name,t):[];let n=e?this.#s.map(s=>this.store.gripsOf(Nc(e,s)).length):[];this.#i.offer(e?.name??null,this.#s,n.find(Boolean)??0)}takeFiles(e){let[t,...n]=e;t&&(this.#v(),this.store.change({inHand:{name:t.name,content:t,resources:new Map(n.map(s=>[s.name,s]))}}))}async start(e){if(!(!e||!this.#n)){await this.#v(),this.#i.say("Reading the file …");try{await this.#m(this.#n,e)}catch(t){this.#i.say("Nothing is held. Choose another way, or another file."),this.told.failed(t)}}}async#m(e,t){let n=++this.#f,s=await Dc(e,t);if(n!==this.#f)return void ut(s.links.self,{method:"DELETE"}).catch(()=>null);[this.#r,this.#p]=[s,!1],this.#a=t,this.#g=t.kind==="deform"?.05:0,this.#o=new Jr(Uc(this.#r),{mesh:r=>this.#l=this.#w(r),frame:(r,o)=>{this.#l.then(()=>this.#A(r,o))},reply:(r,o)=>this.#E(r,o),closed:(r,o)=>this.#_(r,o)}),this.grips.restore(this.store.gripsOf(Nc(e,t)));for(let r of this.grips.all)this.#o.say({add:{name:r.name,handle:ya(r)}});this.#d=0<this.grips.all.length,this.#i.started(e.name,t,this.#g),this.told.changed()}#_(e,t){let[n,s]=[this.#n,this.#a],r=t==="stopping"||e===1006;this.#p=r,this.#M(r?"The service does not answer. Your handles are kept, and taken again as soon as it is back.":rE[t]??`The computation ended: ${t}.`),r&&n&&s&&this.#x(n,s,this.#f)}async#x(e,t,n){for(;this.#p&&n===this.#f;){if(await new Promise(s=>setTimeout(s,oE)),!this.#p||n!==this.#f)return;try{return await this.#m(e,t)}catch(s){if(n=this.#f,!(s instanceof Ki)||500<=s.problem.status)continue;this.#p=!1,this.#i.say("Nothing is held any more."),this.told.failed(s)}}}async leave(){this.#r&&this.#y([]),await this.#v()}#y(e){this.#n&&this.#a&&this.store.hold(Nc(this.#n,this.#a),e)}async#v(){this.#f+=1,this.#p=!1;let e=this.#r;this.#o?.close(),this.#M(""),e&&await ut(e.links.self,{method:"DELETE",keepalive:!0}).catch(()=>null)}#M(e){let t=this.isActive;this.#r=this.#o=null,this.#d=!1,this.grips.take([]),this.#e?.clear(),this.#S(),this.#i.ended(e),t&&this.told.changed()}async#w(e){let{name:t}=this.#n,n=e.picture[1]>0||this.#a.isMap&&["glb","gltf"].includes(cn(t)),s=e.picture[1]>0&&"content"in this.#n?this.#n.content:null;await this.#e?.show(e,{down:n?e.picture[1]||1:null,picture:s,isMap:this.#a.isMap,shown:this.told.shown()}),this.#b(),this.#i.say("")}#b(){let{beside:e}=this.#e??{};if(!e)return;let{shade:t}=this.store.place,n=t==="heat"||t==="material"&&e.hasPicture?t:"checker";e.fill(n),this.#i.filled(n,e.hasPicture),this.#e.refill()}#A(e,t){let n=this.#c!==null;this.#c=e,t!==null&&this.#i.waited(t),!n&&requestAnimationFrame(()=>{let s=this.#c;this.#c=null,!(!s||!this.#o)&&(this.#e?.move(s.positions),this.#i.frame(s),this.#T())})}#T(){let e=this.#e;if(!e?.isMap||this.#h)return;let t=performance.now();this.#i.judged(e.faults()),this.#h=window.setTimeout(()=>{this.#h=0,this.#u!==e.step&&this.#T()},Math.max(100,4*(performance.now()-t))),this.#u=e.step}#E({error:e,handles:t},n){t&&this.grips.take(t),e&&n&&"add"in n&&this.#R(n.add.name,e.code),e&&this.#i.note(e.detail),this.refresh()}#R(e,t){let n=this.grips.all.find(s=>s.name===e);n&&(n.radius&&["handle_outside","unknown_handle","no_handle"].includes(t)?(n.radius=0,this.#o?.say({add:{name:e,handle:ya(n)}})):this.grips.drop(e))}begin(){this.#o?.say({remember:{}}),this.#d=!0}hold({at:e,to:t}){let n=this.grips.add(e,t,this.#a?.isMap||!this.#e?0:this.#g*this.#e.extent);return this.#o?.say({add:{name:n.name,handle:ya(n)}}),n}moved(e,t){for(let n of e){let s=this.grips.all.find(({name:a})=>a===n.name);if(!s)continue;Object.assign(s,n);let{name:r,to:o}=n;this.#o?.say(t&&n.radius?{add:{name:r,handle:ya(n)}}:{move:{name:r,to:o}})}this.#e?.redraw()}cancel(){this.#o?.say({undo:{}})}refresh(){this.#r&&this.#y(this.grips.all),this.#i.refresh(this.grips,this.#t?.gesture??null),this.#e?.redraw()}does(e){let t=this.#o;if(!t)return;let{grips:n}=this;({undo:()=>t.say({undo:{}}),redo:()=>t.say({redo:{}}),bake:()=>{this.bake()},reset:()=>{this.begin(),t.say({reset:{}})},grab:()=>this.#t?.start("grab"),rotate:()=>this.#t?.start("rotate"),scale:()=>this.#t?.start("scale"),lock:()=>n.lock(),next:()=>n.selectNext(),pin:()=>{let r=this.#t?.touched;r&&(this.begin(),this.hold(r))},let_go:()=>this.#C(),confirm:()=>this.#t?.end(!0),frame:()=>this.#e?.frame(),cancel:()=>this.#t?.gesture?this.#t.end(!1):n.select(null),all:()=>n.all.forEach(({name:r})=>n.select(r,!0)),end:()=>{this.leave()}})[e]?.(),this.refresh()}#C(){let e=this.grips.chosen(!0);if(e.length){this.begin();for(let{name:t}of e)this.#o?.say({remove:{name:t}}),this.grips.drop(t)}}async bake(){if(this.#r)try{let e=await ut(this.#r.links.bake,{method:"POST"});this.#d=!1,this.told.baked(e)}catch(e){this.told.failed(e)}}#S(){this.#e&&By(this.#e,this.grips)}};var wh=(i,e,t=1)=>i[(i.indexOf(e)+t+i.length)%i.length];function ky(i){let{viewer:e}=i,t=()=>Ti.filter(s=>s!=="image"||e.hasImage),n=[{key:"o",does:"Choose files",act:()=>i.setup.ask()},{key:"u",does:"Unwrap",act:()=>{i.setup.submit()}},{key:"c",does:"Next fill: charts, checker, heat map …",act:()=>i.change({shade:wh(t(),e.place.shade)})},{key:"h",does:"Heat map, and its next measure",act:()=>i.change(e.place.shade==="heat"?{measure:wh(In,e.place.measure)}:{shade:"heat"})},{key:"e",does:"Seams",act:()=>i.change({seams:!e.place.seams})},{key:"w",does:"Wire",act:()=>i.change({wire:!e.place.wire})},{key:"x",does:"Problems in red",act:()=>i.change({problems:!e.place.problems})},{key:"i",does:"Isolate the selected chart",act:()=>i.change({only:!e.place.only})},{key:"1",does:"Point at faces",act:()=>i.change({aim:"face"})},{key:"2",does:"Point at charts",act:()=>i.change({aim:"chart"})},{key:"3",does:"Point at seams",act:()=>i.change({aim:"seam"})},{key:"Escape",does:"Select nothing",act:()=>e.pointing.select(null)},{key:"f",does:"Show everything",act:()=>e.frame()},{key:"v",does:"Fly to the selected face",act:()=>e.place.face!==null&&e.flyTo(e.place.face)},{key:"b",does:"Before and after",act:()=>i.compare("before")},{key:"d",does:"Before and after, side by side",act:()=>i.compare("both")},{key:"t",does:"Next UV set of the file",act:()=>{let s=e.facts?.sets??[];1<s.length&&i.change(Tf(e,wh(s,e.facts.set)))}},{key:"m",does:"The surface alone, the UVs alone, or both",act:()=>i.change({alone:wh([null,"solid","plane"],e.place.alone)})},{key:" ",does:"Turn, or stop",act:()=>{e.stage?.solid.turn(!e.stage.solid.isTurning),e.stage?.redraw()}},{key:"r",does:"View and report",act:()=>i.change({tab:e.place.tab==="view"?"report":"view"})},{key:"Tab",does:"Arrange islands",act:()=>i.arrange.does("toggle"),shift:!1,inPane:!0,byPointer:!0},{key:"?",does:"These keys",act:()=>bs(n)}];return n}async function zy(i){let e=URL.createObjectURL(i),t=await new Hi().loadAsync(e).finally(()=>URL.revokeObjectURL(e));return t.magFilter=Mt,t.minFilter=Mt,t.generateMipmaps=!1,t.wrapS=t.wrapT=$n,t.colorSpace="",t}var ba=class{constructor(e,t,{set:n,aspect:s},r){this.loaded=e;this.analysis=t;this.aspect=s,this.#e=n,this.surface=yh(t,r),this.sphere=this.surface.layers.solid.surface.geometry.boundingSphere??new It(new U,1),t.drawn.face.forEach((o,a)=>{this.#t.has(o)||this.#t.set(o,a)})}loaded;analysis;surface;sphere;aspect;#e;#t=new Map;get isFlat(){let{positions:e}=this.analysis.drawn;return e.every((t,n)=>n%3!==2||t===e[2])}place(e){let t=this.#t.get(e)??this.#i(e);if(t===void 0)return null;let{positions:n,uvs:s}=this.analysis.drawn,[r,o,a]=[0,3,6].map(h=>new U().fromArray(n,9*t+h)),l=[0,2,4].map(h=>new U(s[6*t+h]*this.aspect,s[6*t+h+1],0)),c=l[0].clone().add(l[1]).add(l[2]).divideScalar(3);return{middle:r.clone().add(o).add(a).divideScalar(3),normal:o.clone().sub(r).cross(a.clone().sub(r)),u:c.x,v:c.y,size:Vy(r,o,a),planeSize:Vy(...l)}}#i(e){let{chart:t,group:n,drawn:s}=this.analysis,r=s.face.findIndex(o=>t[o]===t[e]&&n[o]===n[e]);return 0<=r?r:void 0}picture(){let e=null;return this.loaded.scene.traverse(t=>{let n=t.material?.map;n&&n.channel===this.#e&&(e??=n)}),e}dispose(){this.surface.dispose(),Sg(this.loaded.scene)}};function Vy(i,e,t){return Math.max(i.distanceTo(e),e.distanceTo(t),t.distanceTo(i))}var Ah=class extends Sn{constructor(){super(),this.name="RoomEnvironment",this.position.y=-3.5;let e=new ds;e.deleteAttribute("uv");let t=new Tn({side:jt}),n=new Tn,s=new Ws(16777215,900,28,2);s.position.set(.418,16.199,.3),this.add(s);let r=new je(e,t);r.position.set(-.757,13.219,.717),r.scale.set(31.713,28.305,28.591),this.add(r);let o=new zs(e,n,6),a=new xt;a.position.set(-10.906,2.009,1.846),a.rotation.set(0,-.195,0),a.scale.set(2.328,7.905,4.651),a.updateMatrix(),o.setMatrixAt(0,a.matrix),a.position.set(-5.607,-.754,-.758),a.rotation.set(0,.994,0),a.scale.set(1.97,1.534,3.955),a.updateMatrix(),o.setMatrixAt(1,a.matrix),a.position.set(6.167,.857,7.803),a.rotation.set(0,.561,0),a.scale.set(3.927,6.285,3.687),a.updateMatrix(),o.setMatrixAt(2,a.matrix),a.position.set(-2.017,.018,6.124),a.rotation.set(0,.333,0),a.scale.set(2.002,4.566,2.064),a.updateMatrix(),o.setMatrixAt(3,a.matrix),a.position.set(2.291,-.756,-2.621),a.rotation.set(0,-.286,0),a.scale.set(1.546,1.552,1.496),a.updateMatrix(),o.setMatrixAt(4,a.matrix),a.position.set(-2.193,-.369,-5.547),a.rotation.set(0,.516,0),a.scale.set(3.875,3.487,2.986),a.updateMatrix(),o.setMatrixAt(5,a.matrix),this.add(o);let l=new je(e,to(50));l.position.set(-16.116,14.37,8.208),l.scale.set(.1,2.428,2.739),this.add(l);let c=new je(e,to(50));c.position.set(-16.109,18.021,-8.207),c.scale.set(.1,2.425,2.751),this.add(c);let h=new je(e,to(17));h.position.set(14.904,12.198,-1.832),h.scale.set(.15,4.265,6.331),this.add(h);let u=new je(e,to(43));u.position.set(-.462,8.89,14.52),u.scale.set(4.38,5.441,.088),this.add(u);let d=new je(e,to(20));d.position.set(3.235,11.486,-12.541),d.scale.set(2.5,2,.1),this.add(d);let f=new je(e,to(100));f.position.set(0,20,0),f.scale.set(1,.1,1),this.add(f)}dispose(){let e=new Set;this.traverse(t=>{t.isMesh&&(e.add(t.geometry),e.add(t.material))});for(let t of e)t.dispose()}};function to(i){return new No({color:0,emissive:16777215,emissiveIntensity:i})}var Th=class{#e=new mn(1,1);#t=new Sn;pick(e,t,n,[s,r],[o,a]){let l=n;l.setViewOffset(o,a,Math.floor(s),Math.floor(r),1,1),this.#t.children=t,e.setRenderTarget(this.#e),e.setClearColor(0,0),e.clear(),e.render(this.#t,n);let[c,h,u,d]=this.#i(e);return e.setRenderTarget(null),l.clearViewOffset(),this.#t.children=[],c+256*h+65536*u+16777216*d-1}#i(e){let t=new Uint8Array(4);return e.readRenderTargetPixels(this.#e,0,0,1,1,t),[t[0],t[1],t[2],t[3]]}};var aE={sky:2,key:2},Hy={room:.6,sky:.5,key:.8},lE=64,Eh=class{uniforms=pa();solid;plane;renderer;beside={solid:new Sn,plane:new Sn};#e=new Th;#t;#i=!1;onFrame=()=>{};background="#ffffff";figures={milliseconds:0,frames:0};constructor(e){this.#t=e,this.renderer=new $r({canvas:e.canvas,antialias:!0,alpha:!1,powerPreference:"high-performance"}),this.renderer.toneMapping=Wo,this.renderer.autoClear=!1,this.renderer.info.autoReset=!1,this.solid=new eo([e.solid,e.beside.solid],()=>this.redraw()),this.plane=new Qr([e.plane,e.beside.plane],()=>this.redraw()),new ResizeObserver(()=>this.resize()).observe(e.canvas.parentElement),this.resize()}#n=null;light(){if(!this.#n){let[e,t]=[new qr(this.renderer),new Ah];this.#n=e.fromScene(t,.04,.1,100,{size:lE});for(let n of[this.solid.scene,this.beside.solid])n.environment=this.#n.texture,n.environmentIntensity=Hy.room;t.dispose(),e.dispose()}return Vf(Hy)}restore(){this.#n&&(this.#n.dispose(),this.#n=null,this.light()),this.redraw()}redraw(){this.#i||(this.#i=!0,requestAnimationFrame(()=>{this.#i=!1,this.#s()}))}resize(){let e=this.#t.canvas.parentElement.getBoundingClientRect();if(!(e.width<1||e.height<1)){this.renderer.setPixelRatio(Math.min(devicePixelRatio,2)),this.renderer.setSize(e.width,e.height,!1);for(let t of["solid","plane"]){let{width:n,height:s}=this.#t[t].getBoundingClientRect();n<1||s<1||this[t].resize(n,s)}this.redraw()}}#s(){let e=performance.now();this.solid.update()&&this.redraw(),this.onFrame(),this.renderer.info.reset(),this.renderer.setScissorTest(!0);for(let t of["solid","plane"])this.#a(this.#t[t],this[t].scene,this[t].camera),this.#a(this.#t.beside[t],this.beside[t],this[t].camera);this.figures.milliseconds=performance.now()-e,this.figures.frames+=1}#a(e,t,n){let{left:s,bottom:r,width:o,height:a}=this.#r(e);o<1||a<1||(this.uniforms.uViewport.value.set(o*this.renderer.getPixelRatio(),a*this.renderer.getPixelRatio()),this.uniforms.uPixelRatio.value=this.renderer.getPixelRatio(),this.renderer.setViewport(s,r,o,a),this.renderer.setScissor(s,r,o,a),this.renderer.setClearColor(new be(this.background),1),this.renderer.clear(),this.renderer.render(t,n))}#r(e){let t=this.#t.canvas.getBoundingClientRect(),n=e.getBoundingClientRect();return{left:n.left-t.left,bottom:t.bottom-n.bottom,width:n.width,height:n.height}}pick(e,t,n,s,r){let{width:o,height:a}=this.#t[t].getBoundingClientRect(),l=e.surface.layers[t];this.uniforms.uViewport.value.set(1,1),this.uniforms.uPixelRatio.value=1,this.renderer.setScissorTest(!1);let c=f=>this.#e.pick(this.renderer,f,this[t].camera,[n,s],[o,a]),h=c([l.pickSurface]),u=r?this.#o(l.pickSurface,()=>c([l.pickSurface,l.pickBorders])):-1,{face:d}=e.analysis.drawn;return h<0&&u<0?null:{view:t,border:u,face:0<=h?d[h]??-1:e.analysis.borders.face[u]??-1}}#o({material:e},t){let n=e;n.colorWrite=!1;try{return t()}finally{n.colorWrite=!0}}project(e,t){let{left:n,top:s,width:r,height:o}=this.#t[e].getBoundingClientRect();this[e].camera.updateMatrixWorld();let{x:a,y:l}=t.clone().project(this[e].camera);return[n+(a+1)/2*r,s+(1-l)/2*o]}};function Vf({sky:i,key:e}=aE){let t=new Wi(16777215,e);return t.position.set(1,2,3),[new Gs(16777215,9080728,i),t]}var Rh=class{hovered=null;#e;#t;#i=null;#n=!1;at=null;onHover=()=>{};onSelect=()=>{};taken=null;constructor(e,t){this.#e=e,this.#t=t.canvas.parentElement;for(let n of["solid","plane"])this.#s(n,t[n])}#s(e,t){let n=null;t.addEventListener("pointermove",s=>{if(s.buttons)return;let r=t.getBoundingClientRect();this.#a(e,s.clientX-r.left,s.clientY-r.top)}),t.addEventListener("pointerleave",()=>{this.#i=this.at=null,this.#l(null),this.onHover()}),t.addEventListener("pointerdown",s=>n=s.button===0?[s.clientX,s.clientY]:null),t.addEventListener("pointerup",s=>{if(!n||4<Math.hypot(s.clientX-n[0],s.clientY-n[1]))return;let r=t.getBoundingClientRect(),o=this.#o(e,s.clientX-r.left,s.clientY-r.top);this.taken?this.taken(o,s.shiftKey):this.select(o)})}#a(e,t,n){this.#i={view:e,x:t,y:n},!this.#n&&(this.#n=!0,requestAnimationFrame(()=>{this.#n=!1;let s=this.#i;s&&(this.#r(s),this.#l(this.#o(s.view,s.x,s.y)))}))}#r({view:e,x:t,y:n}){let{stage:s,model:r,isRelaxing:o}=this.#e;if(this.at=null,e==="plane"&&s&&r&&!o){let a=s.plane.element.getBoundingClientRect(),[l,c]=s.plane.at(a.left+t,a.top+n);this.at=[l/r.aspect,c]}this.onHover()}#o(e,t,n){let{stage:s,model:r,place:o}=this.#e;if(!s||!r||e==="plane"&&this.#e.isRelaxing)return null;let a=s.pick(r,e,t,n,o.aim==="seam");return!a||o.aim==="seam"&&a.border<0?null:{view:e,face:a.face,seam:o.aim==="seam"?r.analysis.borders.seam[a.border]??-1:-1}}#l(e){let t=e?.face===this.hovered?.face&&e?.seam===this.hovered?.seam;this.hovered=e,!t&&(this.apply(),this.onHover())}select(e){let{place:t,model:n}=this.#e,s={face:null,chart:null,seam:null};if(!e||!n)return this.onSelect(s);let{chart:r,group:o,atlases:a}=n.analysis,l={face:e.face,chart:r[e.face],seam:e.seam}[t.aim];this.onSelect({...s,atlas:a[o[e.face]]?.name??t.atlas,[t.aim]:l})}apply(){let{stage:e,model:t,place:n,atlas:s}=this.#e;if(!e||!t)return;let{hovered:r}=this,o=cE(t.analysis,n.aim,r);e.uniforms.uHover.value.set(...o),e.uniforms.uSelected.value.set(n.face??-1,n.chart??-1,n.chart===null?-1:s,n.seam??-1);let a={hoverFace:r?.face,hoverChart:r?t.analysis.chart[r.face]:void 0,hoverSeam:r&&0<=r.seam?r.seam:void 0};for(let[l,c]of Object.entries(a))c===void 0?delete this.#t.dataset[l]:this.#t.dataset[l]=String(c);e.redraw()}};function cE({chart:i,group:e},t,n){return n?t==="face"?[n.face,-1,-1,-1]:t==="seam"?[-1,-1,-1,n.seam]:[-1,i[n.face],e[n.face],-1]:[-1,-1,-1,-1]}function Hf(i,e,t){let n=i.record??e.record??{},s=i.texcoord??(()=>n.texcoord??0),[r,o]=[my(e.scene),s(0,0)];if(t===null||t===o||!r.includes(t))return{record:n,texcoord:s,sets:r,set:o,first:o};let{resolution:a}=n;return{record:{resolution:a,texcoord:t,group_by:"material"},texcoord:()=>t,sets:r,set:t,first:o}}var Ch=class{constructor(e){this.store=e;let t={solid:$("solid-beside"),plane:$("plane-beside")},n={canvas:$("canvas"),solid:$("solid"),plane:$("plane"),beside:t};this.stage=hE(n),this.pointing=new Rh(this,n),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>this.apply()),e.show(()=>this.apply())}store;stage;pointing;model=null;analysis=null;facts=null;#e=new xa;#t=null;#i=new xa;#n=Kt.split;#s=0;#a=0;#r=null;#o=null;#l=null;changed=()=>{};get place(){return this.store.place}async show(e){let t=++this.#s;delete $("panes").dataset.shown;let n=await ia(e);if(t!==this.#s)return!1;this.stage&&this.#c(this.stage,n,e);let s=Hf(e,n,this.place.set),r=ma(n,s);if(!r.parts.some(({positions:a})=>a.length))throw new Error("The file has no triangles to show.");let o=await oo(r);return t!==this.#s?!1:(this.facts={source:e,...s,texture:r.texture,origins:gy(r)},this.#f(this.facts,n,o),!0)}async again(){this.facts&&await this.show(this.facts.source)}async showBeside(e){let{stage:t}=this,[n,s]=[this.#s,++this.#a];if(!e&&!this.#t)return;let r=e&&t?await ia(e):null,o=e&&r?Hf(e,r,null):null,a=r&&o?ma(r,o):null,l=a&&await oo(a);if(!(!t||n!==this.#s||s!==this.#a)){if(this.#t?.model.dispose(),this.#t=null,r&&o&&a&&l){let c=oy(t.uniforms);this.#t={uniforms:c,model:new ba(r,l,{set:o.set,aspect:a.texture.width/a.texture.height},c)}}$("panes").classList.toggle("both",this.#t!==null),t.resize(),this.apply(),t.plane.isMoved||this.#p(),this.changed()}}clear(){this.#s+=1,this.calm(),this.showBeside(null),this.model?.dispose(),this.model=this.analysis=this.facts=null,this.stage?.solid.show([],null),this.stage?.plane.show([]),this.stage?.redraw(),this.changed()}relax(e,t){let{stage:n}=this;n&&(this.#o!==e&&(this.calm(),n.plane.frame([0,0,1,1]),this.#d=!1),this.#o=e,$("plane-note").textContent="",$("relaxing").textContent=t,n.plane.show(e.meshes),n.redraw())}get isRelaxing(){return this.#o!==null}calm(){this.#o&&(this.stage?.plane.show([]),this.#o.dispose(),this.#o=null,$("relaxing").textContent="")}#c(e,t,n){this.model||(e.solid.show([t.scene,...Vf()],uE(t.scene)),this.#h(e,n),e.redraw())}#h({solid:e},{model:t,from:n,isTurning:s=!1}){let{camera:r}=this.place;this.#r!==t&&(this.#r=t,this.#d=!1,e.frame(n??(this.model?.isFlat?[0,0,1]:void 0)),e.turn(s&&!r),r&&(e.place=r))}#u({plane:e}){!this.#d&&this.place.plane?e.place=this.place.plane:e.isMoved||this.#p(),this.#d=!0}#d=!1;keepCameras(){let{stage:e}=this;if(!e||!this.#r||e.solid.isTurning||!$("panes").dataset.shown)return;let t=e.solid.isMoved?e.solid.place:null,n=e.plane.isMoved?e.plane.place:null;(t||n)&&this.store.remember(this.#r,{camera:t,plane:n});let{job:s}=this.store;s&&s.id===this.place.job&&fi(s)===this.#r&&this.store.go({camera:t,plane:n})}#f({source:e,set:t,texture:n},s,r){e.isInput||this.calm(),e.isTurning||this.stage?.solid.turn(!1),this.model?.dispose(),this.analysis=r,$("panes").dataset.shown=e.name,performance.mark("first view");let{stage:o}=this;if(!o)return this.changed();this.model=new ba(s,r,{set:t,aspect:n.width/n.height},o.uniforms),this.apply(),this.#h(o,e),this.#u(o),this.#o&&o.plane.frame([0,0,1,1]),this.changed()}get analysisBeside(){return this.#t?.model.analysis??null}get atlas(){let e=this.analysis?.atlases.findIndex(({name:t})=>t===this.place.atlas)??-1;return Math.max(e,0)}frame(e){this.stage?.solid.frame(e??(this.model?.isFlat?[0,0,1]:void 0)),this.#p()}#p(){let e=this.analysis?.atlases[this.atlas];if(!e||!this.model)return;let{aspect:t}=this.model,n=kf(e.bounds),[s,r,o,a]=e.isMapped?e.bounds:[0,0,1,1];this.stage?.plane.frame([Math.min(0,s)*t,Math.min(0,r),Math.max(n,o)*t,Math.max(1,a)])}apply(){let{stage:e,model:t,place:n}=this;if(!e)return;let s=$("panes");if(((s.dataset.alone??null)!==n.alone||n.split!==this.#n)&&(n.alone?s.dataset.alone=n.alone:delete s.dataset.alone,s.style.setProperty("--split",`${n.split}%`),this.#n=n.split,e.resize()),e.background=bn("--stage"),e.redraw(),!t)return;let{uniforms:r}=e,o=n.shade==="image"&&!this.#l?"checker":n.shade;r.uShade.value=Ti.indexOf(o),r.uMeasure.value=In.indexOf(n.measure),r.uAtlas.value=this.atlas,r.uAspect.value=t.aspect,r.uSeams.value=Number(n.seams),r.uWire.value=Number(n.wire),r.uProblems.value=Number(n.problems),r.uOnly.value.set(...n.only&&n.chart!==null?[n.chart,this.atlas]:[-1,-1]),r.uChecker.value.set(n.cells,n.cells/t.aspect),r.uRange.value.set(...this.range()),this.#l&&(r.uImage.value=this.#l),this.pointing.apply();let a=Gy(e,t,{place:n,atlas:this.atlas,sheet:this.#e});e.solid.show(a.solid,t.sphere),e.plane.show(this.#o?.meshes??a.plane),this.#g(e),e.redraw()}#g(e){let{place:t}=this;for(let a of Object.values(e.beside))a.clear();if(!this.#t)return;let{model:n,uniforms:s}=this.#t;s.uAspect.value=n.aspect,s.uChecker.value.set(t.cells,t.cells/n.aspect);let{solid:r,plane:o}=Gy(e,n,{place:t,atlas:0,sheet:this.#i});e.beside.solid.add(...r),e.beside.plane.add(...o)}range(){let e=this.analysis?.atlases[this.atlas]?.spreads[In.indexOf(this.place.measure)];return e?_y(this.place.measure,e,this.place.scale):[0,1]}get shown(){let{analysis:e,facts:t,model:n}=this;return e&&t&&n&&{analysis:e,origins:t.origins,texture:t.texture,picture:n.picture()??this.#l}}async useImage(e){let t=await zy(e);this.#l?.dispose(),this.#l=t}get hasImage(){return this.#l!==null}flyTo(e){let t=this.model?.place(e);!t||!this.stage||(this.stage.solid.flyTo(t.middle,t.normal,t.size),Number.isFinite(t.u)&&this.stage.plane.flyTo(t.u,t.v,t.planeSize))}project(e,t){let n=this.model?.place(t);if(!n||!this.stage)return null;let s=e==="solid"?n.middle:n.middle.clone().set(n.u,n.v,0);return this.stage.project(e,s)}};function Gy(i,e,{place:t,atlas:n,sheet:s}){let{solid:r,plane:o}=e.surface.layers,a=t.shade==="material"&&!(t.only&&t.chart!==null),l=e.analysis.atlases[n],c=a?e.picture():null,h={paper:bn("--sheet"),line:bn("--sheet-line"),border:bn("--sheet-border")};return{solid:[...a?[e.loaded.scene,...i.light(),r.overlay]:[r.surface],r.borders],plane:[...s.of(l?kf(l.bounds):1,e.aspect,h,c),c?o.overlay:o.surface,o.borders]}}function hE(i){try{return new Eh(i)}catch{return null}}function uE(i){return new gn().setFromObject(i).getBoundingSphere(new It)}var Ve=new Ic(zh()),ct=new Ch(Ve),dE=new sh(ct,es,Yy),sr=new nh(Ve,i=>{rr(i)},i=>As.listed(i)),Ih=new lh(Ve,{shown:i=>{qy(i)},made:$y,failed:ts}),As=new eh({store:Ve,viewer:ct,list:sr,setup:Ih,failed:ts,ended:Dh,removed:()=>{rr(null)},made:$y}),Lh=new Sh(Ve,{failed:ts,changed:Nh,shown:()=>Ve.state.inHand?null:ct.shown,baked:i=>{sr.refresh(),rr(i.id,{...Lc(Ve.place)})}}),no=new qc(ct,{failed:ts,open:i=>rr(i,{...Ve.place,face:null,chart:null,seam:null}),changed:Nh}),Ph=null,Wy=["view","report","pull"];function es(i){let{set:e}=Ve.place;Ve.go(i),Ve.place.set!==e&&ct.again().catch(ts)}function Nh(){let{place:i,subject:e,inHand:t}=Ve.state,n=e.kind==="job"?e:null;dE.refresh(As.before()!==null),My(ct,es),no.offer(Xy()?Ve.job:null,n?.report??null),no.isOn||Df(ct);for(let r of Wy)$(`tab-${r}`).setAttribute("aria-selected",String(i.tab===r)),$(r).hidden=i.tab!==r;i.tab==="report"&&yE(),i.tab==="pull"&&Lh.offer(t??fE(),t?null:pE());let s=i.tab==="pull"&&Lh.isActive;$("inspector").hidden=s,$("pull-facts").hidden=!s,Ty(Ve.state)}function Xy(){let{facts:i}=ct;return Ve.place.uvs!=="before"&&i?.set===i?.first}function fE(){let{subject:i,chosen:e}=Ve.state;if(i.kind==="file")return i.file;let t=i.kind==="job"&&i.job.state==="succeeded"?Qn(i.job,"result"):void 0;return i.kind==="job"&&t?{name:t.name,job:i.job.id}:e[0]??null}function pE(){return{isMapped:ct.analysis?.atlases.some(({isMapped:i})=>i)??!1,isFlat:ct.model?.isFlat??!1}}function Dh(){$("problem").hidden=!0}function ts(i){let e=i instanceof Error?i.message:String(i),t=F("button",{type:"button",textContent:"Close",on:{click:Dh}});$("problem").replaceChildren(F("span",{textContent:e}),t),$("problem").hidden=!1}async function rr(i,e={...Lc(Ve.place),tab:Ve.place.tab}){Dh(),ct.keepCameras(),Ph=null,Ve.change({inHand:null});let t=sr.find(i),n=e.camera||e.plane||!t?{}:Ve.cameraOf(fi(t));Ve.go({...e,...n,job:i},i!==Ve.place.job);try{let[s]=Ve.state.chosen;i?await As.open(i):s?await qy(s):await mE()}catch(s){As.leave(),Ve.change({subject:{kind:"missing"}}),ct.clear(),$("inspector").replaceChildren(),ts(s)}}async function mE(){Ih.choose([{name:"spot.ply",content:await _s("assets/sample.ply"),resources:new Map,from:[-.8,.3,-1]}])}async function qy(i){As.leave(),ct.keepCameras();let e={kind:"file",file:i};Ve.change({subject:e,inHand:null});let{tab:t}=Ve.place;Ve.go({...Lc(Ve.place),...Ve.cameraOf(oa(i)),tab:t==="pull"?t:Kt.tab}),ti("Reading the file …"),Dh(),$("inspector").replaceChildren();try{ct.clear(),await ct.show({...i,model:oa(i),isTurning:!0})&&gE(ct.analysis)}catch(n){if(Ve.state.subject!==e)return;ti(n instanceof Yi?n.message:""),n instanceof Yi||ts(n),$("inspector").replaceChildren(F("section",{},F("h2",{textContent:"File"}),ui([["Name",i.name],["Size",ji(i.content.size)]])))}}function gE(i){if(!i)return;let e=i.atlases.some(n=>n.isMapped),t=e?i.atlases.reduce((n,s)=>n+s.unmapped,0):0;ti(e?"":"No UVs yet. Unwrap makes them."),$("inspector").replaceChildren(F("section",{},F("h2",{textContent:"File"}),ui([["Faces",vt(i.faces)],["Surface area",et(i.area)],["UV charts",e?vt(i.charts):"none"],...t?[["Faces without UVs",vt(t)]]:[]])),F("section",{className:"intro"},F("h2",{textContent:"What comes back"}),F("p",{textContent:"The same mesh with UVs in which no face is flipped and no two overlap. That is proven on the bytes of the file."})))}function $y(i){for(let{job:e,input:t}of i)As.remember(e,t);sr.add(i.map(({job:e})=>e)),sr.refresh(),rr(i[0].job.id)}async function yE(){let{subject:i}=Ve.state;if(i.kind!=="job"){$("report").replaceChildren(F("p",{className:"none",textContent:"The report of a job is shown here. Unwrap a mesh, or choose a job."}));return}let{job:e}=i,t=()=>uy({job:e,report:i.report,analysis:Xy()?ct.analysis:null,before:Ph?.analysis??null,atlas:ct.atlas,flyTo:xE});t();let n=As.before();if(Ph||!n)return;let s=await ia(n).catch(()=>null);if(!s)return;let{record:r={}}=n,o=await oo(ma(s,{record:r,texcoord:()=>r.texcoord??0}));Ve.job===e&&(Ph={job:e,analysis:o},Ve.place.tab==="report"&&t())}function xE(i){es({tab:"view",aim:"face",face:i,chart:null,seam:null}),ct.stage?.resize(),ct.flyTo(i)}function Yy(i){As.before()&&es({uvs:Ve.place.uvs===i?"after":i})}function vE(){let[i,e,t]=[ky({viewer:ct,setup:Ih,arrange:no,change:es,compare:Yy}),Ey(Lh),f0(no)],n=()=>Ve.place.tab==="pull"?e:Ve.place.tab==="view"&&no.isOn?t:i;d0(n),$("keys-button").addEventListener("click",()=>bs(n()));for(let s of Wy)$(`tab-${s}`).addEventListener("click",()=>es({tab:s}));ct.pointing.onHover=()=>no.isOn||Df(ct),ct.pointing.onSelect=es,ct.changed=Nh,Ve.show(Nh),Zs.changed=s=>{$("connection").hidden=s,s||sr.refresh()},m0(Ve,es),Ay(()=>ct.apply()),addEventListener("popstate",()=>{let s=zh();s.job!==Ve.place.job?rr(s.job,s):es(s)}),g0(s=>Ve.place.tab==="pull"?Lh.takeFiles(s):Ih.takeFiles(s))}async function _E(){await ut("v1/sign-in",{method:"DELETE"}),ep(),location.hash="",location.reload()}vE();ct.stage&&ny(ct,ct.stage);ut("v1/sign-in").then(i=>hg(i,()=>{_E().catch(ts)}),ts);Object.assign(window,{unwrapd:{viewer:ct,store:Ve,address:Et}});await Promise.all([sr.refresh(),rr(Ve.place.job,Ve.place)]);
/*! Bundled license information:

three/build/three.core.js:
three/build/three.module.js:
  (**
   * @license
   * Copyright 2010-2026 Three.js Authors
   * SPDX-License-Identifier: MIT
   *)

three/examples/jsm/libs/fflate.module.js:
  (*!
  fflate - fast JavaScript compression/decompression
  <https://101arrowz.github.io/fflate>
  Licensed under MIT. https://github.com/101arrowz/fflate/blob/master/LICENSE
  version 0.8.3
  *)
*/
